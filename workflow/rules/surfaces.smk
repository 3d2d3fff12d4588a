# Rules that make the surfaces for boundary elements: generated discs and prepared measured surfaces, in files of the
# same form. The files are temporary (`--notemp` keeps them). Each batch has a separate file: if batches shared a file,
# adding a batch would make Snakemake compute the curves of all batches again. Lines are not stored
# (rules/curves.smk).


rule generate_discs:
    """A batch of discs."""
    output:
        surfaces=temp("results/surfaces/discs/{sample}/{batch}.nc"),
    log:
        "results/logs/generate_discs/{sample}/{batch}.log",
    benchmark:
        "results/benchmarks/generate_discs/{sample}/{batch}.tsv"
    priority: 1  # start the long jobs that indent the discs early; at the end, short jobs then share the cores evenly
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: samples.generation_memory(DISCS[wildcards.sample]["ensembles"]),
    params:
        ensembles=lambda wildcards: batch_ensembles(DISCS, wildcards.sample, wildcards.batch),
        seed=config["seed"],
        source=digest("generate_discs"),
    message:
        "Discs {wildcards.sample}, realizations {wildcards.batch}"
    script:
        "../scripts/generate_discs.py"


use rule generate_discs as generate_examples with:
    """Discs of Figure 1."""
    output:
        surfaces="results/surfaces/examples.nc",
    log:
        "results/logs/generate_examples.log",
    benchmark:
        "results/benchmarks/generate_examples.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=samples.generation_memory(samples.example_discs(config)),
    params:
        ensembles=samples.example_discs(config),
        seed=config["seed"],
        source=digest("generate_discs"),
    message:
        "Discs of Figure 1"


rule prepare_measured:
    """A measured surface, prepared as the settings say."""
    input:
        # the param `source` shows changes of the content, so the time of the file is ignored
        heights=ancient(scan_value("file")),
    output:
        surfaces=temp("results/surfaces/measured/{scan}/0000-0000.nc"),
    log:
        "results/logs/prepare_measured/{scan}.log",
    benchmark:
        "results/benchmarks/prepare_measured/{scan}.tsv"
    priority: 1  # as for discs
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: samples.measured_memory(MEASURED[wildcards.scan]),
    params:
        name=lambda wildcards: wildcards.scan,
        group=scan_value("group"),
        spacing=scan_value("spacing"),
        unit=scan_value("unit"),
        preparation=scan_value("preparation"),
        source=lambda wildcards: [digest("prepare_measured"), MEASURED[wildcards.scan]["digest"]],
    message:
        "Measured surface {wildcards.scan}"
    script:
        "../scripts/prepare_measured.py"
