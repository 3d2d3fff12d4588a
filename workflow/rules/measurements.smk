# Cost of one disc on grids from coarse to fine, each in a separate process, whose peak memory counts.


rule measure_large:
    output:
        csv="results/large/{elements}.csv",
    threads: ALL_CORES
    resources:
        mem_mb=lambda wildcards: cases.large_memory(int(wildcards.elements)),
    params:
        seed=config["seed"],
        hurst=config["large"]["hurst"],
        tolerance=config["indentation"]["tolerance"],
        until_fraction=config["large"]["until_fraction"],
        warm_up=min(config["large"]["elements"]),
    message:
        "Cost of a disc of {wildcards.elements} elements across"
    script:
        "../scripts/measure_large.py"
