# Where each method fails: `all` makes the map on small indenters, `make stability` on larger ones.


rule map_failures:
    output:
        csv="results/tables/failure_map.csv",
        html=report(
            "results/tables/failure_map.html",
            caption="../report/failure_map_table.rst",
            category=chapter("failures"),
            labels={"result": "every method in every stress-test case", "kind": "table"},
        ),
        nc="results/tables/failure_map.nc",
    log:
        "results/logs/map_failures.log",
    benchmark:
        "results/benchmarks/map_failures.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
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


rule plot_failure_map:
    input:
        table=rules.map_failures.output.csv,
    output:
        png=report(
            "results/figures/failure_map.png",
            caption="../report/failure_map.rst",
            category=chapter("failures"),
            labels={"result": "every method in every stress-test case", "kind": "figure"},
        ),
        pdf="results/figures/failure_map.pdf",
    log:
        "results/logs/plot_failure_map.log",
    benchmark:
        "results/benchmarks/plot_failure_map.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure of every method in every stress-test case"
    script:
        "../scripts/plot_failure_map.py"
