# Where each method fails: `stability` makes it, `all` does not, for it takes minutes.


rule measure_stability:
    output:
        csv=report(
            "results/tables/stability.csv",
            caption="../report/stability_table.rst",
            category="Stability",
            labels={"table": "every method in every difficulty"},
        ),
        nc="results/tables/stability.nc",
    log:
        "results/logs/measure_stability.log",
    benchmark:
        "results/benchmarks/measure_stability.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=4000,
    params:
        source_digest("measure_stability"),
        seed=config["seed"],
        across=config["stability"]["across"],
        grids=config["stability"]["grids"],
    message:
        "Every method in every difficulty"
    script:
        "../scripts/measure_stability.py"


rule measure_stability_curves:
    output:
        csv="results/tables/stability_curves.csv",
        nc="results/tables/stability_curves.nc",
    log:
        "results/logs/measure_stability_curves.log",
    benchmark:
        "results/benchmarks/measure_stability_curves.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=2000,
    params:
        source_digest("measure_stability_curves"),
        seed=config["seed"],
    message:
        "Errors against steps and contact"
    script:
        "../scripts/measure_stability_curves.py"


rule plot_stability:
    input:
        atlas=rules.measure_stability.output.csv,
        curves=rules.measure_stability_curves.output.csv,
    output:
        atlas=report(
            "results/figures/stability.png",
            caption="../report/stability.rst",
            category="Stability",
            labels={"figure": "every method in every difficulty"},
        ),
        curves=report(
            "results/figures/stability_curves.png",
            caption="../report/stability_curves.rst",
            category="Stability",
            labels={"figure": "errors against steps and contact"},
        ),
        pdfs=multiext("results/figures/", "stability.pdf", "stability_curves.pdf"),
    log:
        "results/logs/plot_stability.log",
    benchmark:
        "results/benchmarks/plot_stability.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        source_digest("plot_stability"),
    message:
        "Figures of stability"
    script:
        "../scripts/plot_stability.py"
