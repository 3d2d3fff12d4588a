# Other media than the paper's: the same loading curves, read with another creep compliance.


rule compute_media:
    input:
        curves=curves_of_first_combination,
    output:
        csv="results/tables/media.csv",
        html=report(
            "results/tables/media.html",
            caption="../report/media_table.rst",
            category=chapter("beyond"),
            labels={"result": "kinetics in other media", "kind": "table"},
        ),
        nc="results/tables/media.nc",
    log:
        "results/logs/compute_media.log",
    benchmark:
        "results/benchmarks/compute_media.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        **config["media"],
        rms_convention=config["figures"]["rms_convention"],
    message:
        "Kinetics in other media"
    script:
        "../scripts/compute_media.py"


rule plot_media:
    input:
        table=rules.compute_media.output.csv,
    output:
        png=report(
            "results/figures/media.png",
            caption="../report/media.rst",
            category=chapter("beyond"),
            labels={"result": "kinetics in other media", "kind": "figure"},
        ),
        pdf="results/figures/media.pdf",
    log:
        "results/logs/plot_media.log",
    benchmark:
        "results/benchmarks/plot_media.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure of kinetics in other media"
    script:
        "../scripts/plot_media.py"
