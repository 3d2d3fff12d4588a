# Penetration of self-affine rough indenters into a linearly viscous half-space: the paper's figures and beyond.
# `snakemake --cores 2` makes the paper's figures and verdicts, `snakemake --cores 2 figure_4` one figure, and
# `snakemake --cores 2 beyond` what goes beyond the paper; settings are in config/.

from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


# True unless another workflow, which uses this workflow as a module, has defined rules before: its first rule then
# remains the default target. Not documented: the default target as an attribute.
IS_DEFAULT = workflow.default_target is None

# Not documented: the files that the settings come from. Messages on wrong settings and the page name them.
SETTINGS_FILES = workflow.overwrite_configfiles
settings, MEASURED = complete(config, SETTINGS_FILES)
config.update(settings)


report: "workflow/report/workflow.rst"


DISCS = cases.disc_cases(config)
LINES = cases.line_cases(config)
NESTED = cases.nested_cases(config)
CASES = {"discs": DISCS, "lines": LINES, "measured": MEASURED}


wildcard_constraints:
    kind="discs|measured",
    case="|".join([*DISCS, *MEASURED]),
    line="|".join(LINES),
    nested="|".join(NESTED) or "no_grid",
    scan="|".join(MEASURED) or "no_scan",
    pool="|".join(cases.POOLS),
    batch=r"\d{4}-\d{4}",
    format="png|pdf",


# The chain from surfaces to the page. Each file uses the results of the files before it.
include: "workflow/rules/surfaces.smk"
include: "workflow/rules/curves.smk"
include: "workflow/rules/fits.smk"
include: "workflow/rules/comparisons.smk"
include: "workflow/rules/timings.smk"
include: "workflow/rules/verdicts.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/page.smk"
include: "workflow/rules/beyond.smk"


onstart:
    # Not documented: the scheduler. With its limit of jobs per second, which has no public way to be switched off,
    # Snakemake 9.0 to 9.27 looks for ready jobs once a second for every job that has ended.
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None
    compile_once(SOURCES.digest(SOURCES.folder / "viscorough_study/run/kernels.py"))


rule all:
    """Figures 1 to 4, the verdicts, speed against accuracy, stress tests, and the page of the results."""
    default_target: IS_DEFAULT
    input:
        rules.tabulate_rule_costs.input,
        rules.tabulate_rule_costs.output,
        rules.make_page.output,


SOURCES.keep()
