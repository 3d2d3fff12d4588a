# Rules that measure computing times, and compare the cost and the error of models. Jobs that measure times run alone.
# They have a high priority: at the end of a run, the jobs that use their tables would have to wait for them.


rule measure_methods:
    """Cost and error of every method."""
    output:
        csv="results/tables/methods.csv",
    log:
        "results/logs/measure_methods.log",
    benchmark:
        "results/benchmarks/measure_methods.tsv"
    priority: 3
    conda:
        "../envs/viscorough.yaml"
    threads: ALL_CORES
    resources:
        mem_mb=8000,
    params:
        **chosen("methods", "levels", "repeats", "longest"),
        problems=samples.method_problems(config),
        seed=config["seed"],
        source=digest("measure_methods"),
    message:
        "Cost and error of every method"
    script:
        "../scripts/measure_methods.py"


rule measure_one_surface:
    """Cost and error of every model of one surface."""
    output:
        csv="results/tables/one_surface.csv",
    log:
        "results/logs/measure_one_surface.log",
    benchmark:
        "results/benchmarks/measure_one_surface.tsv"
    priority: 3
    conda:
        "../envs/viscorough.yaml"
    threads: ALL_CORES
    resources:
        mem_mb=samples.grid_memory(config["methods"]["one_surface"]["elements"]),
    params:
        **config["methods"]["one_surface"],
        hurst=[0.4, 0.8],
        seed=config["seed"],
        source=digest("measure_one_surface"),
    message:
        "Cost and error of every model of one surface"
    script:
        "../scripts/measure_one_surface.py"


rule compare_mean_accuracy:
    """Cost and error of every model of the mean of many surfaces."""
    input:
        discs="results/ensembles/discs.nc",
        coarse="results/ensembles/coarse.nc",
        lines="results/ensembles/lines.nc",
        mdr_lambda="results/tables/mdr_lambda.csv",
        scaling="results/tables/scaling.csv",
        one_surface="results/tables/one_surface.csv",
    output:
        csv="results/tables/mean_accuracy.csv",
    log:
        "results/logs/compare_mean_accuracy.log",
    benchmark:
        "results/benchmarks/compare_mean_accuracy.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        conventions=SHOWN,
        source=digest("compare_mean_accuracy"),
    message:
        "Cost and error of every model of the mean of many surfaces"
    script:
        "../scripts/compare_mean_accuracy.py"


rule choose_sufficient_models:
    """The cheapest sufficient model for every question."""
    input:
        one_surface="results/tables/one_surface.csv",
        mean_accuracy="results/tables/mean_accuracy.csv",
    output:
        csv="results/tables/sufficient_models.csv",
    log:
        "results/logs/choose_sufficient_models.log",
    benchmark:
        "results/benchmarks/choose_sufficient_models.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("choose_sufficient_models"),
    message:
        "The cheapest sufficient model for every question"
    script:
        "../scripts/choose_sufficient_models.py"
