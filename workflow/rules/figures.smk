# Figures 1 to 4 of the paper, and what its conventions change. PNG for the report, PDF as vector graphics.


rule generate_example_discs:
    output:
        surfaces="results/surfaces/examples.nc",
    log:
        "results/logs/generate_example_discs.log",
    benchmark:
        "results/benchmarks/generate_example_discs.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=cases.example_memory(config),
    params:
        **cases.example_discs(config),
        seed=config["seed"],
        elements=config["discs"]["elements"],
    message:
        "Discs of Figure 1"
    script:
        "../scripts/generate_example_discs.py"


rule plot_surfaces:
    input:
        surfaces=rules.generate_example_discs.output.surfaces,
    output:
        png=report(
            "results/figures/fig1_surfaces.png",
            caption="../report/fig1_surfaces.rst",
            category=chapter("figures"),
            labels={"result": "1, surfaces", "kind": "figure"},
        ),
        pdf="results/figures/fig1_surfaces.pdf",
    log:
        "results/logs/plot_surfaces.log",
    benchmark:
        "results/benchmarks/plot_surfaces.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure 1, surfaces"
    script:
        "../scripts/plot_surfaces.py"


rule plot_kinetics:
    input:
        discs="results/ensembles/discs.nc",
        scaling=rules.fit_scaling.output.csv,
    output:
        png=report(
            "results/figures/fig2_kinetics.png",
            caption="../report/fig2_kinetics.rst",
            category=chapter("figures"),
            labels={"result": "2, kinetics", "kind": "figure"},
        ),
        pdf="results/figures/fig2_kinetics.pdf",
    log:
        "results/logs/plot_kinetics.log",
    benchmark:
        "results/benchmarks/plot_kinetics.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        combinations=combinations(),
        conventions=config["figures"],
        fraction_min=config["scaling"]["fraction_min"],
    message:
        "Figure 2, kinetics"
    script:
        "../scripts/plot_kinetics.py"


rule plot_master_curve:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        scaling=rules.fit_scaling.output.csv,
    output:
        png=report(
            "results/figures/fig3_master_curve.png",
            caption="../report/fig3_master_curve.rst",
            category=chapter("figures"),
            labels={"result": "3, master curve", "kind": "figure"},
        ),
        pdf="results/figures/fig3_master_curve.pdf",
    log:
        "results/logs/plot_master_curve.log",
    benchmark:
        "results/benchmarks/plot_master_curve.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
        fraction_min=config["scaling"]["fraction_min"],
    message:
        "Figure 3, master curve"
    script:
        "../scripts/plot_master_curve.py"


rule plot_exponent:
    input:
        scaling=rules.fit_scaling.output.csv,
    output:
        png=report(
            "results/figures/fig4_exponent.png",
            caption="../report/fig4_exponent.rst",
            category=chapter("figures"),
            labels={"result": "4, exponent", "kind": "figure"},
        ),
        pdf="results/figures/fig4_exponent.pdf",
    log:
        "results/logs/plot_exponent.log",
    benchmark:
        "results/benchmarks/plot_exponent.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
        hurst_range=paper("laws")["beta"]["hurst_range"],
    message:
        "Figure 4, exponent"
    script:
        "../scripts/plot_exponent.py"


rule plot_conventions:
    input:
        scaling=rules.fit_scaling.output.csv,
    output:
        png=report(
            "results/figures/conventions.png",
            caption="../report/conventions.rst",
            category=chapter("choices"),
            labels={"result": "what the conventions do", "kind": "figure"},
        ),
        pdf="results/figures/conventions.pdf",
    log:
        "results/logs/plot_conventions.log",
    benchmark:
        "results/benchmarks/plot_conventions.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
    message:
        "Figure of the conventions"
    script:
        "../scripts/plot_conventions.py"
