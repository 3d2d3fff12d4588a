# Other media than the paper's: the same loading curves, read with another creep compliance.


rule compute_media:
    input:
        curves=curves_of_combinations(),
    output:
        csv="results/tables/media.csv",
        html=report(
            "results/tables/media.html",
            caption="../report/media_table.rst",
            category=chapter("beyond"),
            labels={"result": "kinetics in other media", "kind": "table"},
        ),
        nc="results/tables/media.nc",
        exponents_csv="results/tables/media_exponents.csv",
        exponents_html=report(
            "results/tables/media_exponents.html",
            caption="../report/media_exponents_table.rst",
            category=chapter("beyond"),
            labels={"result": "exponents of time in other media", "kind": "table"},
        ),
        exponents_nc="results/tables/media_exponents.nc",
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
        **{name: config["scaling"][name] for name in ("stiffness_range", "resamples")},
        rms_convention=config["figures"]["rms_convention"],
        discs=cases.first_combination(config),
        until_x=config["indentation"]["until_x"],
        seed=config["seed"],
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


rule plot_media_exponents:
    input:
        table=rules.compute_media.output.csv,
    output:
        png=report(
            "results/figures/media_exponents.png",
            caption="../report/media_exponents.rst",
            category=chapter("beyond"),
            labels={"result": "exponents of time in other media", "kind": "figure"},
        ),
        pdf="results/figures/media_exponents.pdf",
    log:
        "results/logs/plot_media_exponents.log",
    benchmark:
        "results/benchmarks/plot_media_exponents.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure of exponents of time in other media"
    script:
        "../scripts/plot_media_exponents.py"
