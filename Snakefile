# The workflow is in workflow/; this file lets `snakemake --cores 2` find it from here.


include: "workflow/Snakefile"


workflow.default_target = "all"  # an included file sets none
