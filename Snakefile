# Penetration of self-affine rough indenters into a linearly viscous half-space: the paper's figures and beyond.
# `snakemake --cores 2` makes everything, `snakemake --cores 2 figure_4` one figure; settings are in config/.

from snakemake.utils import min_version

min_version("9.0")


configfile: f"{workflow.basedir}/config/config.yaml"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/settings.smk"


check_settings(config)
DISCS = disc_cases(config)
LINES = line_cases(config)
PROBLEMS = method_problems(config)


wildcard_constraints:
    case="|".join(DISCS),
    line="|".join(LINES),
    problem="|".join(PROBLEMS),
    batch=r"\d{4}-\d{4}",
    elements=r"\d+",


include: "workflow/rules/surfaces.smk"
include: "workflow/rules/indentation.smk"
include: "workflow/rules/ensemble.smk"
include: "workflow/rules/scaling.smk"
include: "workflow/rules/validation.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/methods.smk"
include: "workflow/rules/stability.smk"
include: "workflow/rules/sizes.smk"


# On a cluster, where Snakemake runs; too short for a queue.
localrules:
    aggregate_discs,
    aggregate_lines,
    check_validation,
    compare_direct,
    compare_prefactors,
    fit_scaling,
    fit_sizes,
    generate_example_discs,
    judge_claims,
    plot_conventions,
    plot_exponent,
    plot_kinetics,
    plot_large,
    plot_master_curve,
    plot_methods,
    plot_sizes,
    plot_stability,
    plot_surfaces,
    plot_validation,
    tabulate_calibration,
    tabulate_methods,
    tabulate_prices,


onstart:
    compile_kernels()


rule figure_1:
    input:
        rules.plot_surfaces.output,


rule figure_2:
    input:
        rules.plot_kinetics.output,


rule figure_3:
    input:
        rules.plot_master_curve.output,


rule figure_4:
    input:
        rules.plot_exponent.output,


rule figures:
    input:
        rules.plot_surfaces.output,
        rules.plot_kinetics.output,
        rules.plot_master_curve.output,
        rules.plot_exponent.output,
        rules.plot_conventions.output,
        rules.compare_prefactors.output,
        rules.compare_reduction.output,
        rules.compare_direct.output,
        rules.plot_validation.output,


rule tables:
    input:
        rules.fit_scaling.output,
        rules.validate.output,
        rules.judge_claims.output,
        rules.tabulate_calibration.output,


rule validation:
    input:
        rules.check_validation.output,


rule speed:
    input:
        rules.plot_methods.output,


rule stability:
    input:
        rules.plot_stability.output,


rule sizes:
    input:
        rules.plot_sizes.output,


rule large:
    input:
        rules.plot_large.output,


rule all:
    default_target: True
    input:
        rules.figures.input,
        rules.tables.input,
        rules.validation.input,


include: "workflow/rules/prices.smk"


rule prices:
    input:
        rules.tabulate_prices.output,
