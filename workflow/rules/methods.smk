# Speed against accuracy of every method, ours and others': `speed` makes it, `all` does not, for it takes over an hour.
# Every job takes all cores, so that nothing runs beside what is timed.


rule measure_methods:
    output:
        csv="results/methods/{problem}.csv",
    log:
        "results/logs/measure_methods/{problem}.log",
    benchmark:
        "results/benchmarks/measure_methods/{problem}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: workflow.cores
    resources:
        mem_mb=8000,
    params:
        source_digest("measure_methods"),
        problem=lambda wildcards: PROBLEMS[wildcards.problem],
        seed=config["seed"],
        levels=config["methods"]["levels"],
        repeats=config["methods"]["repeats"],
        longest=config["methods"]["longest"],
        peers=peers(),
    message:
        "Cost and error of every method: {wildcards.problem}"
    script:
        "../scripts/measure_methods.py"


rule tabulate_methods:
    input:
        tables=expand("results/methods/{problem}.csv", problem=PROBLEMS),
    output:
        csv=report(
            "results/tables/methods.csv",
            caption="../report/methods_table.rst",
            category="Methods",
            labels={"table": "speed and accuracy"},
        ),
        nc="results/tables/methods.nc",
    log:
        "results/logs/tabulate_methods.log",
    benchmark:
        "results/benchmarks/tabulate_methods.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=500,
    params:
        source_digest("tabulate_methods"),
    message:
        "Table of all methods"
    script:
        "../scripts/tabulate_methods.py"


rule race_peers:
    output:
        csv=report(
            "results/tables/peers.csv",
            caption="../report/peers_table.rst",
            category="Methods",
            labels={"table": "comparison with other solvers"},
        ),
        nc="results/tables/peers.nc",
    log:
        "results/logs/race_peers.log",
    benchmark:
        "results/benchmarks/race_peers.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: workflow.cores
    resources:
        mem_mb=8000,
    params:
        source_digest("race_peers"),
        seed=config["seed"],
        hurst=config["methods"]["hurst"],
        repeats=config["methods"]["repeats"],
        longest=config["methods"]["longest"],
        tasks=config["methods"]["tasks"],
        peers=peers(),
    message:
        "The same levels by other solvers"
    script:
        "../scripts/race_peers.py"


rule compare_scenes:
    output:
        csv=report(
            "results/tables/scenes.csv",
            caption="../report/scenes_table.rst",
            category="Methods",
            labels={"table": "levels chosen for a scene"},
        ),
        nc="results/tables/scenes.nc",
    log:
        "results/logs/compare_scenes.log",
    benchmark:
        "results/benchmarks/compare_scenes.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: workflow.cores
    resources:
        mem_mb=4000,
    params:
        source_digest("compare_scenes"),
        **config["methods"]["scenes"],
        seed=config["seed"],
        repeats=config["methods"]["repeats"],
    message:
        "Levels chosen for a scene: by the package, by hand, naively"
    script:
        "../scripts/compare_scenes.py"


rule plot_methods:
    input:
        methods=rules.tabulate_methods.output.csv,
        peers=rules.race_peers.output.csv,
        scenes=rules.compare_scenes.output.csv,
    output:
        speed=report(
            "results/figures/speed.png",
            caption="../report/speed.rst",
            category="Methods",
            labels={"figure": "speed against accuracy"},
        ),
        growth=report(
            "results/figures/growth.png",
            caption="../report/growth.rst",
            category="Methods",
            labels={"figure": "cost against number of elements"},
        ),
        peers=report(
            "results/figures/peers.png",
            caption="../report/peers.rst",
            category="Methods",
            labels={"figure": "other solvers"},
        ),
        scenes=report(
            "results/figures/scenes.png",
            caption="../report/scenes.rst",
            category="Methods",
            labels={"figure": "levels chosen for a scene"},
        ),
        pdfs=multiext("results/figures/", "speed.pdf", "growth.pdf", "peers.pdf", "scenes.pdf"),
    log:
        "results/logs/plot_methods.log",
    benchmark:
        "results/benchmarks/plot_methods.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        source_digest("plot_methods"),
    message:
        "Figures of speed and accuracy"
    script:
        "../scripts/plot_methods.py"
