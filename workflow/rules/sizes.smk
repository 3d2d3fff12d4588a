# Grids from coarse to fine: exponents of ensembles (`sizes`), and the cost of one disc (`large`).


rule fit_sizes:
    input:
        discs="results/ensembles/size_discs.nc",
        lines="results/ensembles/size_lines.nc",
    output:
        csv="results/tables/sizes.csv",
        nc="results/tables/sizes.nc",
        trends_csv="results/tables/sizes_trends.csv",
        trends_nc="results/tables/sizes_trends.nc",
    log:
        "results/logs/fit_sizes.log",
    benchmark:
        "results/benchmarks/fit_sizes.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        seed=config["seed"],
        fit=config["scaling"],
        windows=config["sizes"]["windows"],
        tolerance=paper("claims")["beta"]["tolerance"],
        conventions=config["figures"],
    message:
        "Exponents on grids from coarse to fine"
    script:
        "../scripts/fit_sizes.py"


rule fit_collapse:
    input:
        discs="results/ensembles/size_discs.nc",
        lines="results/ensembles/size_lines.nc",
    output:
        collapse_csv="results/tables/collapse.csv",
        collapse_nc="results/tables/collapse.nc",
        infinite_csv="results/tables/infinite_grid.csv",
        infinite_nc="results/tables/infinite_grid.nc",
        curves_csv="results/tables/collapse_curves.csv",
        curves_nc="results/tables/collapse_curves.nc",
    log:
        "results/logs/fit_collapse.log",
    benchmark:
        "results/benchmarks/fit_collapse.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        ranges=config["collapse"],
        conventions=config["figures"],
        fraction_min=config["scaling"]["fraction_min"],
        tolerance=paper("claims")["beta"]["tolerance"],
        seed=config["seed"],
    message:
        "Collapse of the curves of all grids, and the exponent of an infinitely fine grid"
    script:
        "../scripts/fit_collapse.py"


rule measure_large:
    output:
        csv="results/large/{elements}.csv",
        curve="results/large/{elements}.nc",
    log:
        "results/logs/measure_large/{elements}.log",
    benchmark:
        "results/benchmarks/measure_large/{elements}.tsv"
    conda:
        "../envs/viscorough.yaml"
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


rule tabulate_large:
    input:
        costs=expand(rules.measure_large.output.csv, elements=config["large"]["elements"]),
    output:
        csv="results/tables/large.csv",
        nc="results/tables/large.nc",
    log:
        "results/logs/tabulate_large.log",
    benchmark:
        "results/benchmarks/tabulate_large.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    message:
        "Table of the cost of one disc"
    script:
        "../scripts/tabulate_large.py"
