# Rules that draw the figures. The rule plot_NAME draws with the function plot_NAME in
# src/viscorough_study/figures/NAME.py. The report and the page show the figures as PNG files. To get a PDF file, name
# it: `snakemake --cores 2 results/figures/fig4_exponent.pdf`.


rule plot_surfaces:
    """Figure: 1, surfaces."""
    input:
        examples="results/surfaces/examples.nc",
    output:
        figure=report(
            "results/figures/fig1_surfaces.{format}",
            caption="../report/figures/fig1_surfaces.rst",
            category="2 Figures of the paper",
            labels={"result": "1, surfaces", "kind": "figure"},
        ),
    log:
        "results/logs/plot_surfaces/{format}.log",
    benchmark:
        "results/benchmarks/plot_surfaces/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_surfaces"),
    message:
        "Figure: 1, surfaces"
    script:
        "../scripts/plot_surfaces.py"


rule plot_kinetics:
    """Figure: 2, kinetics."""
    input:
        discs="results/ensembles/discs.nc",
        scaling="results/tables/scaling.csv",
    output:
        figure=report(
            "results/figures/fig2_kinetics.{format}",
            caption="../report/figures/fig2_kinetics.rst",
            category="2 Figures of the paper",
            labels={"result": "2, kinetics", "kind": "figure"},
        ),
    log:
        "results/logs/plot_kinetics/{format}.log",
    benchmark:
        "results/benchmarks/plot_kinetics/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        combinations=samples.combinations(config),
        conventions=SHOWN,
        fraction_min=config["scaling"]["fraction_min"],
        source=digest("plot_kinetics"),
    message:
        "Figure: 2, kinetics"
    script:
        "../scripts/plot_kinetics.py"


rule plot_master_curve:
    """Figure: 3, master curve."""
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        scaling="results/tables/scaling.csv",
    output:
        figure=report(
            "results/figures/fig3_master_curve.{format}",
            caption="../report/figures/fig3_master_curve.rst",
            category="2 Figures of the paper",
            labels={"result": "3, master curve", "kind": "figure"},
        ),
    log:
        "results/logs/plot_master_curve/{format}.log",
    benchmark:
        "results/benchmarks/plot_master_curve/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        conventions=SHOWN,
        fraction_min=config["scaling"]["fraction_min"],
        source=digest("plot_master_curve"),
    message:
        "Figure: 3, master curve"
    script:
        "../scripts/plot_master_curve.py"


rule plot_exponent:
    """Figure: 4, exponent."""
    input:
        scaling="results/tables/scaling.csv",
    output:
        figure=report(
            "results/figures/fig4_exponent.{format}",
            caption="../report/figures/fig4_exponent.rst",
            category="2 Figures of the paper",
            labels={"result": "4, exponent", "kind": "figure"},
        ),
    log:
        "results/logs/plot_exponent/{format}.log",
    benchmark:
        "results/benchmarks/plot_exponent/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        conventions=SHOWN,
        hurst_min=NUMBERS["agreement"]["beta_hurst_min"]["value"],
        fine_grids=judged_rows(PROJECT),
        source=digest("plot_exponent"),
    message:
        "Figure: 4, exponent"
    script:
        "../scripts/plot_exponent.py"


rule plot_regions:
    """Figure: regions of the curves."""
    input:
        discs="results/ensembles/discs.nc",
        local_slope="results/tables/local_slope.csv",
    output:
        figure=report(
            "results/figures/regions.{format}",
            caption="../report/figures/regions.rst",
            category="3 Verdicts",
            labels={"result": "regions of the curves", "kind": "figure"},
        ),
    log:
        "results/logs/plot_regions/{format}.log",
    benchmark:
        "results/benchmarks/plot_regions/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        fraction_min=config["scaling"]["fraction_min"],
        half_width=config["scaling"]["slope_half_width"],
        source=digest("plot_regions"),
    message:
        "Figure: regions of the curves"
    script:
        "../scripts/plot_regions.py"


rule plot_direct:
    """Figure: direct integration and both readings of the law."""
    input:
        direct="results/tables/direct.csv",
    output:
        figure=report(
            "results/figures/direct.{format}",
            caption="../report/figures/direct.rst",
            category="3 Verdicts",
            labels={"result": "direct integration and both readings of the law", "kind": "figure"},
        ),
    log:
        "results/logs/plot_direct/{format}.log",
    benchmark:
        "results/benchmarks/plot_direct/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_direct"),
    message:
        "Figure: direct integration and both readings of the law"
    script:
        "../scripts/plot_direct.py"


rule plot_mdr_lambda:
    """Figure: MDR, lambda and exponents."""
    input:
        mdr_lambda="results/tables/mdr_lambda.csv",
        mdr_exponents="results/tables/mdr_exponents.csv",
    output:
        figure=report(
            "results/figures/mdr_lambda.{format}",
            caption="../report/figures/mdr_lambda.rst",
            category="3 Verdicts",
            labels={"result": "MDR, lambda and exponents", "kind": "figure"},
        ),
    log:
        "results/logs/plot_mdr_lambda/{format}.log",
    benchmark:
        "results/benchmarks/plot_mdr_lambda/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_mdr_lambda"),
    message:
        "Figure: MDR, lambda and exponents"
    script:
        "../scripts/plot_mdr_lambda.py"


rule plot_validation:
    """Figure: comparison with exact solutions."""
    input:
        validation="results/tables/validation.csv",
    output:
        figure=report(
            "results/figures/validation.{format}",
            caption="../report/figures/validation.rst",
            category="4 Conventions and validation",
            labels={"result": "comparison with exact solutions", "kind": "figure"},
        ),
    log:
        "results/logs/plot_validation/{format}.log",
    benchmark:
        "results/benchmarks/plot_validation/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_validation"),
    message:
        "Figure: comparison with exact solutions"
    script:
        "../scripts/plot_validation.py"


rule plot_speed:
    """Figure: speed against accuracy."""
    input:
        mean_accuracy="results/tables/mean_accuracy.csv",
    output:
        figure=report(
            "results/figures/speed.{format}",
            caption="../report/figures/speed.rst",
            category="6 Speed and accuracy",
            labels={"result": "speed against accuracy", "kind": "figure"},
        ),
    log:
        "results/logs/plot_speed/{format}.log",
    benchmark:
        "results/benchmarks/plot_speed/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        other_solvers=read_records(PROJECT / "resources/published/other_solvers.csv"),
        source=digest("plot_speed"),
    message:
        "Figure: speed against accuracy"
    script:
        "../scripts/plot_speed.py"


rule plot_failures:
    """Figure: where methods fail."""
    input:
        failures="results/tables/failures.csv",
    output:
        figure=report(
            "results/figures/failures.{format}",
            caption="../report/figures/failures.rst",
            category="7 Where methods fail",
            labels={"result": "where methods fail", "kind": "figure"},
        ),
    log:
        "results/logs/plot_failures/{format}.log",
    benchmark:
        "results/benchmarks/plot_failures/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_failures"),
    message:
        "Figure: where methods fail"
    script:
        "../scripts/plot_failures.py"


rule plot_local_exponent:
    """Figure: local exponent over X."""
    input:
        fine_exponents="results/tables/fine_exponents.csv",
    output:
        figure=report(
            "results/figures/local_exponent.{format}",
            caption="../report/figures/local_exponent.rst",
            category="8 Beyond the paper",
            labels={"result": "local exponent over X", "kind": "figure"},
        ),
    log:
        "results/logs/plot_local_exponent/{format}.log",
    benchmark:
        "results/benchmarks/plot_local_exponent/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_local_exponent"),
    message:
        "Figure: local exponent over X"
    script:
        "../scripts/plot_local_exponent.py"


rule plot_measured:
    """Figure: measured surfaces."""
    input:
        measured="results/ensembles/measured.nc",
        discs="results/ensembles/discs.nc",
        fits="results/tables/measured_fits.csv",
        kinetics="results/tables/measured_kinetics.csv",
    output:
        figure=report(
            "results/figures/measured.{format}",
            caption="../report/figures/measured.rst",
            category="8 Beyond the paper",
            labels={"result": "measured surfaces", "kind": "figure"},
        ),
    log:
        "results/logs/plot_measured/{format}.log",
    benchmark:
        "results/benchmarks/plot_measured/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        conventions=SHOWN,
        fraction_min=config["scaling"]["fraction_min"],
        source=digest("plot_measured"),
    message:
        "Figure: measured surfaces"
    script:
        "../scripts/plot_measured.py"


# ---- targets


rule figure_1:
    """Figure 1 of the paper: surfaces."""
    input:
        "results/figures/fig1_surfaces.png",


rule figure_2:
    """Figure 2 of the paper: kinetics, and their collapse."""
    input:
        "results/figures/fig2_kinetics.png",


rule figure_3:
    """Figure 3 of the paper: velocity of discs and lines, and the paper's law."""
    input:
        "results/figures/fig3_master_curve.png",


rule figure_4:
    """Figure 4 of the paper: exponent over Hurst exponent."""
    input:
        "results/figures/fig4_exponent.png",


rule speed:
    """Speed against accuracy of every model and method."""
    input:
        "results/figures/speed.png",


rule stability:
    """Where methods fail."""
    input:
        "results/figures/failures.png",


rule fine_grids:
    """Exponents of small X on fine grids, and their limits."""
    input:
        "results/tables/fine_exponents.csv",
        "results/figures/local_exponent.png",
