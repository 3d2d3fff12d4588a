# Realizations of one case on common abscissae, and their averages.


rule aggregate_discs:
    input:
        curves=curves_of_disc,
    output:
        ensemble="results/ensembles/discs/{case}.nc",
    log:
        "results/logs/aggregate_discs/{case}.log",
    benchmark:
        "results/benchmarks/aggregate_discs/{case}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        source_digest("aggregate_discs"),
        **config["ensemble"],
    message:
        "Ensemble of discs {wildcards.case}"
    script:
        "../scripts/aggregate_discs.py"


rule aggregate_lines:
    input:
        curves=curves_of_line,
    output:
        ensemble="results/ensembles/lines/{line}.nc",
    log:
        "results/logs/aggregate_lines/{line}.log",
    benchmark:
        "results/benchmarks/aggregate_lines/{line}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        source_digest("aggregate_lines"),
        **config["ensemble"],
    message:
        "Ensemble of lines {wildcards.line}"
    script:
        "../scripts/aggregate_lines.py"
