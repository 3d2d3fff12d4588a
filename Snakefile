# Penetration of self-affine rough indenters into a linearly viscous half-space: the paper's figures and beyond.
# `snakemake --cores 2` makes the paper's figures and verdicts, `snakemake --cores 2 figure_4` one figure, and
# `snakemake --cores 2 beyond` what goes beyond the paper; settings are in config/.

from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


# A plain path would be looked for in the working directory. Another workflow that uses this workflow as a module may
# give settings, and this line is then left out; `complete` adds the default settings in any case.
configfile: PROJECT / "config" / "config.yaml"


# Not documented: the settings files of the command line. Messages on wrong settings and the page name them.
SETTINGS_FILES = workflow.overwrite_configfiles
settings, MEASURED = complete(config, SETTINGS_FILES)
config.update(settings)


report: "workflow/report/workflow.rst"


DISCS = samples.disc_samples(config)
LINES = samples.line_samples(config)
NESTED = samples.nested_samples(config)
SAMPLES = {"discs": DISCS, "lines": LINES, "measured": MEASURED}


wildcard_constraints:
    kind="discs|measured",
    sample="|".join([*DISCS, *MEASURED]),
    line="|".join(LINES),
    nested="|".join(NESTED) or "no_grid",
    scan="|".join(MEASURED) or "no_scan",
    pool="|".join(samples.POOLS),
    batch=r"\d{4}-\d{4}",
    format="png|pdf",


rule all:
    """Figures 1 to 4, the verdicts, speed against accuracy, stress tests, and the page of the results."""
    input:
        "results/index.html",
        "results/tables/validation_passed.txt",


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
    compile_once(SOURCES.digest(SOURCES.folder / "viscorough_study/run/kernels.py"))


SOURCES.keep()
