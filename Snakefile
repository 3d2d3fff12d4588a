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
include: "workflow/rules/table_pages.smk"


onstart:
    compile_kernels()


rule curves:
    input:
        curves_of_pool("discs"),
        curves_of_pool("lines"),


for number, name in enumerate(("surfaces", "kinetics", "master_curve", "exponent"), 1):

    rule:
        name:
            f"figure_{number}"
        input:
            getattr(rules, f"plot_{name}").output,


rule figures:
    input:
        [one.output for one in plots_of("all")],


rule tables:
    input:
        expand(
            "results/tables/{table}.{kind}",
            table=[table for table in tables_of("all") if table != "rule_costs"],
            kind=("csv", "nc"),
        ),


rule validation:
    input:
        rules.check_validation.output,


rule measured:
    input:
        [one.output for one in (*plots_of("measured"), rules.show_tables_of_measured)] if MEASURED else [],


rule speed:
    input:
        [one.output for one in (rules.plot_speed, rules.plot_level_placement, *plots_of("speed"))],
        rules.show_tables_of_speed.output,


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
        rules.show_tables_of_large.output,


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
        rules.show_tables_of_all.output,
        rules.make_page.output,


add_source_digests(workflow.rules)
