# What the rules cost that made what is shown; `prices` makes it, `all` does not, for it differs from run to run.


rule tabulate_prices:
    input:
        rules.all.input,
    output:
        csv=report(
            "results/tables/prices.csv",
            caption="../report/prices.rst",
            category="Prices",
            labels={"table": "time and memory of every rule"},
        ),
        nc="results/tables/prices.nc",
    log:
        "results/logs/tabulate_prices.log",
    benchmark:
        "results/benchmarks/tabulate_prices.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=500,
    params:
        source_digest("tabulate_prices"),
        benchmarks="results/benchmarks",
    message:
        "Time and memory of every rule"
    script:
        "../scripts/tabulate_prices.py"
