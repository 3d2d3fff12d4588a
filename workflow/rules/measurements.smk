# Measured times: every method on every indenter, and one disc on grids from coarse to fine. `make speed` measures them
# on more indenters, and other solvers, which takes over an hour.


rule measure_methods:
    output:
        csv="results/methods/{problem}.csv",
    threads: ALL_CORES
    resources:
        mem_mb=8000,
    params:
        problem=lambda wildcards: PROBLEMS[wildcards.problem],
        seed=config["seed"],
        levels=config["methods"]["levels"],
        repeats=config["methods"]["repeats"],
        longest=config["methods"]["longest"],
    message:
        "Cost and error of every method: {wildcards.problem}"
    script:
        "../scripts/measure_methods.py"


rule measure_large:
    output:
        csv="results/large/{elements}.csv",
    threads: ALL_CORES
    resources:
        mem_mb=large_memory,
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
