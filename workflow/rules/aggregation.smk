# This rule brings the realizations of all cases in a pool to common abscissae.


rule aggregate_curves:
    input:
        curves=lambda wildcards: cases.pool_curves(CASES, wildcards.pool),
    output:
        pool="results/ensembles/{pool}.nc",
    log:
        "results/logs/aggregate_curves/{pool}.log",
    benchmark:
        "results/benchmarks/aggregate_curves/{pool}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.pool_memory(CASES, wildcards.pool, config["ensemble"]),
    params:
        groups=lambda wildcards: cases.pool_groups(CASES, wildcards.pool),
        conventions=lambda wildcards: cases.POOLS[wildcards.pool],
        ensemble=config["ensemble"],
    message:
        "Realizations on common abscissae: {wildcards.pool}"
    script:
        "../scripts/aggregate_curves.py"
