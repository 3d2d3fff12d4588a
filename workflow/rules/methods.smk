# Speed against accuracy of every method, and levels for a scene. `make speed` measures more methods on more indenters,
# and other solvers, which takes over an hour.


rule measure_methods:
    output:
        csv="results/methods/{problem}.csv",
    log:
        "results/logs/measure_methods/{problem}.log",
    benchmark:
        "results/benchmarks/measure_methods/{problem}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: ALL_CORES
    resources:
        mem_mb=8000,
    params:
        adapter_digests(),
        problem=lambda wildcards: PROBLEMS[wildcards.problem],
        groups=config["methods"]["groups"],
        seed=config["seed"],
        levels=config["methods"]["levels"],
        region={name: config["scaling"][name] for name in ("elements_min", "stiffness_max")},
        repeats=config["methods"]["repeats"],
        longest=config["methods"]["longest"],
        # In pairs of close levels, a solution that takes no start cannot win.
        peers=(
            {name: paths for name, paths in other_solvers().items() if name != "ASPHER nested"}
            if other_solvers_wanted()
            else {}
        ),
    message:
        "Cost and error of every method: {wildcards.problem}"
    script:
        "../scripts/measure_methods.py"


rule tabulate_methods:
    input:
        tables=expand("results/methods/{problem}.csv", problem=PROBLEMS),
    output:
        csv="results/tables/methods.csv",
        nc="results/tables/methods.nc",
        equal_csv="results/tables/equal_error.csv",
        equal_nc="results/tables/equal_error.nc",
    log:
        "results/logs/tabulate_methods.log",
    benchmark:
        "results/benchmarks/tabulate_methods.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=500,
    params:
        settings={name: value for name, value in config["methods"].items() if name not in ("tasks", "scenes", "pairs")}
        | {"seed": config["seed"]},
    message:
        "Table of all methods"
    script:
        "../scripts/tabulate_methods.py"


rule time_other_solvers:
    output:
        csv="results/tables/other_solvers.csv",
        nc="results/tables/other_solvers.nc",
    log:
        "results/logs/time_other_solvers.log",
    benchmark:
        "results/benchmarks/time_other_solvers.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: ALL_CORES
    resources:
        mem_mb=8000,
    params:
        adapter_digests(),
        seed=config["seed"],
        hurst=config["methods"]["hurst"],
        pairs=config["methods"]["pairs"],
        longest=config["methods"]["longest"],
        tasks=config["methods"]["tasks"],
        peers=other_solvers(),
    message:
        "The same levels by other solvers"
    script:
        "../scripts/time_other_solvers.py"


rule compare_level_placement:
    output:
        csv="results/tables/level_placement.csv",
        nc="results/tables/level_placement.nc",
    log:
        "results/logs/compare_level_placement.log",
    benchmark:
        "results/benchmarks/compare_level_placement.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: ALL_CORES
    resources:
        mem_mb=4000,
    params:
        **config["methods"]["scenes"],
        seed=config["seed"],
        repeats=config["methods"]["repeats"],
    message:
        "Placement of levels: by the package, by hand, naively"
    script:
        "../scripts/compare_level_placement.py"
