# What others found, and the figure that has it beside our own values.


rule tabulate_literature:
    input:
        scaling=rules.fit_scaling.output.csv,
        interface=rules.fit_interface.output.csv,
        reduction=rules.compare_reduction.output.csv,
    output:
        csv="results/tables/literature.csv",
        nc="results/tables/literature.nc",
    log:
        "results/logs/tabulate_literature.log",
    benchmark:
        "results/benchmarks/tabulate_literature.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        entries=read_yaml("resources/literature/stiffness.yaml"),
        conventions=config["figures"],
    message:
        "What others found"
    script:
        "../scripts/tabulate_literature.py"
