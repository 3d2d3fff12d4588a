# Realizations of all cases on common abscissae.


rule aggregate_curves:
    input:
        curves=lambda wildcards: curves_of_pool(wildcards.pool),
    output:
        pool="results/ensembles/{pool}.nc",
    localrule: True
    resources:
        mem_mb=pool_memory,
    params:
        groups=groups_of_pool,
        conventions=lambda wildcards: cases.POOLS[wildcards.pool],
        ensemble=config["ensemble"],
    message:
        "Realizations on common abscissae: {wildcards.pool}"
    script:
        "../scripts/aggregate_curves.py"
