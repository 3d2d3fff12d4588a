# Rules that write surfaces: the discs of Figure 1, and prepared measured surfaces, which are temporary (`--notemp` keeps
# them). Other discs and lines are not stored (rules/curves.smk).


rule generate_examples:
    output:
        surfaces="results/surfaces/examples.nc",
    log:
        "results/logs/generate_examples.log",
    benchmark:
        "results/benchmarks/generate_examples.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=cases.generation_memory(cases.example_discs(config)),
    params:
        ensembles=cases.example_discs(config),
        seed=config["seed"],
        source=digest("generate_examples"),
    message:
        "Discs of Figure 1"
    script:
        "../scripts/generate_examples.py"


rule prepare_measured:
    input:
        # the param `source` shows changes of the content, so the time of the file is ignored
        heights=ancient(scan_value("file")),
    output:
        surfaces=temp("results/surfaces/measured/{scan}/0000-0000.nc"),
    log:
        "results/logs/prepare_measured/{scan}.log",
    benchmark:
        "results/benchmarks/prepare_measured/{scan}.tsv"
    priority: 1  # start the long jobs that indent the surfaces early
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.measured_memory(MEASURED[wildcards.scan]),
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
