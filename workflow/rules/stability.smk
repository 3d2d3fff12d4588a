# Where each method fails: `all` makes the map on small indenters, `make stability` on larger ones.


rule map_failures:
    output:
        csv="results/tables/failure_map.csv",
        nc="results/tables/failure_map.nc",
    log:
        "results/logs/map_failures.log",
    benchmark:
        "results/benchmarks/map_failures.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        seed=config["seed"],
        across=config["stability"]["across"],
        grids=config["stability"]["grids"],
        hurst_min=number(paper("numbers"), "agreement", "beta_hurst_min"),
    message:
        "Every method in every stress-test case"
    script:
        "../scripts/map_failures.py"
