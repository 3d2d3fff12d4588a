# Measured surfaces of the settings, beside the generated ones.


rule indent_measured:
    input:
        heights=of_scan("file"),
    output:
        curves="results/curves/measured/{scan}/0000-0000.nc",
    log:
        "results/logs/indent_measured/{scan}.log",
    benchmark:
        "results/benchmarks/indent_measured/{scan}.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=measured_memory,
    params:
        of_scan("digest"),
        name=lambda wildcards: wildcards.scan,
        group=of_scan("group"),
        spacing=of_scan("spacing"),
        unit=of_scan("unit"),
        preparation=of_scan("preparation"),
        indentation=config["indentation"],
    message:
        "Boundary elements, measured surface {wildcards.scan}"
    script:
        "../scripts/indent_measured.py"
