# Penetration of self-affine rough indenters into a linearly viscous half-space: the paper's figures and beyond.
# `snakemake --cores 2` makes everything, `snakemake --cores 2 figure_4` one figure; settings are in config/.

from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


require_readable([f"{workflow.basedir}/config/config.yaml", *workflow.overwrite_configfiles])


configfile: f"{workflow.basedir}/config/config.yaml"


report: "workflow/report/workflow.rst"


require_valid(config)
DISCS = cases.disc_cases(config)
LINES = cases.line_cases(config)
MEASURED = measured_cases(config["measured"])
PROBLEMS = cases.method_problems(config)


wildcard_constraints:
    case="|".join(DISCS),
    line="|".join(LINES),
    scan="|".join(MEASURED) or "no_scan",
    problem="|".join(PROBLEMS),
    pool="|".join(cases.POOLS),
    batch=r"\d{4}-\d{4}",
    elements=r"\d+",


include: "workflow/rules/indentation.smk"
include: "workflow/rules/pools.smk"
include: "workflow/rules/scaling.smk"
include: "workflow/rules/interface.smk"
include: "workflow/rules/validation.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/mdr.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/literature.smk"
include: "workflow/rules/methods.smk"
include: "workflow/rules/stability.smk"
include: "workflow/rules/sizes.smk"
include: "workflow/rules/media.smk"
include: "workflow/rules/measured.smk"


onstart:
    compile_kernels()


rule curves:
    input:
        curves_of_pool("discs"),
        curves_of_pool("lines"),


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
        rules.plot_prefactors.output,
        rules.plot_interface.output,
        rules.plot_reduction.output,
        rules.plot_mdr_lambda.output,
        rules.plot_direct.output,
        rules.plot_validation.output,
        rules.plot_speed.output,
        rules.plot_failure_map.output,
        rules.plot_level_placement.output,
        rules.plot_media.output,
        rules.plot_media_exponents.output,
        rules.plot_sizes.output,
        rules.plot_collapse.output,


rule tables:
    input:
        rules.fit_scaling.output,
        rules.validate.output,
        rules.judge_claims.output,
        rules.tabulate_calibration.output,
        rules.compare_prefactors.output,
        rules.compare_zeta_laws.output,
        rules.tabulate_literature.output,
        rules.fit_interface.output,
        rules.compare_reduction.output,
        rules.match_lines.output,
        rules.compare_direct.output,
        rules.tabulate_methods.output,
        rules.map_failures.output,
        rules.compare_level_placement.output,
        rules.compute_media.output,
        rules.fit_sizes.output,
        rules.fit_collapse.output,


rule validation:
    input:
        rules.check_validation.output,


rule measured:
    input:
        rules.evaluate_measured.output if MEASURED else [],
        rules.plot_measured.output if MEASURED else [],


rule speed:
    input:
        rules.tabulate_methods.output,
        rules.plot_speed.output,
        rules.plot_growth.output,
        rules.plot_other_solvers.output,
        rules.plot_level_placement.output,


rule stability:
    input:
        rules.plot_failure_map.output,


rule sizes:
    input:
        rules.plot_sizes.output,
        rules.plot_collapse.output,


rule large:
    input:
        rules.plot_large.output,


include: "workflow/rules/rule_costs.smk"
include: "workflow/rules/page.smk"


rule costs:
    input:
        rules.tabulate_rule_costs.output,


rule all:
    default_target: True
    input:
        rules.figures.input,
        rules.tables.input,
        rules.validation.input,
        rules.measured.input,
        rules.costs.input,
        rules.make_page.output,


add_source_digests(workflow.rules)
