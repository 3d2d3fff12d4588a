# What others found, and the figure that has it beside our own values.


rule tabulate_literature:
    input:
        scaling=rules.fit_scaling.output.csv,
        interface=rules.fit_interface.output.csv,
        reduction=rules.compare_reduction.output.csv,
    output:
        csv="results/tables/literature.csv",
        html=report(
            "results/tables/literature.html",
            caption="../report/literature.rst",
            category=chapter("beyond"),
            labels={"result": "what others found", "kind": "table"},
        ),
        nc="results/tables/literature.nc",
    log:
        "results/logs/tabulate_literature.log",
    benchmark:
        "results/benchmarks/tabulate_literature.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        entries=read_yaml("resources/literature/stiffness.yaml"),
        conventions=config["figures"],
    message:
        "What others found"
    script:
        "../scripts/tabulate_literature.py"


rule plot_interface:
    input:
        table=rules.fit_interface.output.csv,
        curves=rules.fit_interface.output.curves_csv,
        literature=rules.tabulate_literature.output.csv,
    output:
        png=report(
            "results/figures/interface.png",
            caption="../report/interface.rst",
            category=chapter("beyond"),
            labels={"result": "interface and punch in series", "kind": "figure"},
        ),
        pdf="results/figures/interface.pdf",
    log:
        "results/logs/plot_interface.log",
    benchmark:
        "results/benchmarks/plot_interface.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
    message:
        "Figure of the interface and the punch in series"
    script:
        "../scripts/plot_interface.py"
