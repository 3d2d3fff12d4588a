# Rules that draw the figures. The rule plot_NAME draws with the function plot_NAME in
# src/viscorough_study/figures/NAME.py. All rules share the script plot.py; directives that a rule does not state are the
# directives of the first rule. The report and the page show the figures as PNG files. To get a PDF file, name it:
# `snakemake --cores 2 results/figures/fig4_exponent.pdf`.


rule plot_surfaces:
    input:
        examples="results/surfaces/examples.nc",
    output:
        path=report(
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
        figure="surfaces",
        source=digest("plot", figure="surfaces"),
    message:
        "Figure: 1, surfaces"
    script:
        "../scripts/plot.py"


use rule plot_surfaces as plot_kinetics with:
    input:
        ensembles="results/ensembles/discs.nc",
        scaling="results/tables/scaling.csv",
    output:
        path=report(
            "results/figures/fig2_kinetics.{format}",
            caption="../report/figures/fig2_kinetics.rst",
            category="2 Figures of the paper",
            labels={"result": "2, kinetics", "kind": "figure"},
        ),
    log:
        "results/logs/plot_kinetics/{format}.log",
    benchmark:
        "results/benchmarks/plot_kinetics/{format}.tsv"
    params:
        figure="kinetics",
        options={
            "combinations": {
                name: ensemble["combination"] for name, ensemble in samples.combined_ensembles(config).items()
            },
            "conventions": SHOWN,
            "fraction_min": config["scaling"]["fraction_min"],
        },
        source=digest("plot", figure="kinetics"),
    message:
        "Figure: 2, kinetics"


use rule plot_surfaces as plot_master_curve with:
    input:
        discs="results/ensembles/discs.nc",
        longer_period="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        scaling="results/tables/scaling.csv",
    output:
        path=report(
            "results/figures/fig3_master_curve.{format}",
            caption="../report/figures/fig3_master_curve.rst",
            category="2 Figures of the paper",
            labels={"result": "3, master curve", "kind": "figure"},
        ),
    log:
        "results/logs/plot_master_curve/{format}.log",
    benchmark:
        "results/benchmarks/plot_master_curve/{format}.tsv"
    params:
        figure="master_curve",
        options={
            "conventions": SHOWN,
            "fraction_min": config["scaling"]["fraction_min"],
        },
        source=digest("plot", figure="master_curve"),
    message:
        "Figure: 3, master curve"


use rule plot_surfaces as plot_exponent with:
    input:
        scaling="results/tables/scaling.csv",
    output:
        path=report(
            "results/figures/fig4_exponent.{format}",
            caption="../report/figures/fig4_exponent.rst",
            category="2 Figures of the paper",
            labels={"result": "4, exponent", "kind": "figure"},
        ),
    log:
        "results/logs/plot_exponent/{format}.log",
    benchmark:
        "results/benchmarks/plot_exponent/{format}.tsv"
    params:
        figure="exponent",
        options={
            "conventions": SHOWN,
            "hurst_range": paper("laws")["beta"]["hurst_range"],
            "fine_grids": judged_rows(PROJECT),
        },
        source=digest("plot", figure="exponent"),
    message:
        "Figure: 4, exponent"


use rule plot_surfaces as plot_regions with:
    input:
        discs="results/ensembles/discs.nc",
        controls="results/ensembles/discs.nc",
        local_slope="results/tables/local_slope.csv",
    output:
        path=report(
            "results/figures/regions.{format}",
            caption="../report/figures/regions.rst",
            category="3 Verdicts",
            labels={"result": "regions of the curves", "kind": "figure"},
        ),
    log:
        "results/logs/plot_regions/{format}.log",
    benchmark:
        "results/benchmarks/plot_regions/{format}.tsv"
    params:
        figure="regions",
        options={
            "fraction_min": config["scaling"]["fraction_min"],
        },
        source=digest("plot", figure="regions"),
    message:
        "Figure: regions of the curves"


use rule plot_surfaces as plot_direct with:
    input:
        table="results/tables/direct.csv",
    output:
        path=report(
            "results/figures/direct.{format}",
            caption="../report/figures/direct.rst",
            category="3 Verdicts",
            labels={"result": "direct integration and both readings of the law", "kind": "figure"},
        ),
    log:
        "results/logs/plot_direct/{format}.log",
    benchmark:
        "results/benchmarks/plot_direct/{format}.tsv"
    params:
        figure="direct",
        source=digest("plot", figure="direct"),
    message:
        "Figure: direct integration and both readings of the law"


use rule plot_surfaces as plot_mdr_lambda with:
    input:
        lambdas="results/tables/mdr_lambda.csv",
        exponents="results/tables/mdr_exponents.csv",
    output:
        path=report(
            "results/figures/mdr_lambda.{format}",
            caption="../report/figures/mdr_lambda.rst",
            category="3 Verdicts",
            labels={"result": "MDR, lambda and exponents", "kind": "figure"},
        ),
    log:
        "results/logs/plot_mdr_lambda/{format}.log",
    benchmark:
        "results/benchmarks/plot_mdr_lambda/{format}.tsv"
    params:
        figure="mdr_lambda",
        source=digest("plot", figure="mdr_lambda"),
    message:
        "Figure: MDR, lambda and exponents"


use rule plot_surfaces as plot_validation with:
    input:
        table="results/tables/validation.csv",
    output:
        path=report(
            "results/figures/validation.{format}",
            caption="../report/figures/validation.rst",
            category="4 Conventions and validation",
            labels={"result": "comparison with exact solutions", "kind": "figure"},
        ),
    log:
        "results/logs/plot_validation/{format}.log",
    benchmark:
        "results/benchmarks/plot_validation/{format}.tsv"
    params:
        figure="validation",
        source=digest("plot", figure="validation"),
    message:
        "Figure: comparison with exact solutions"


use rule plot_surfaces as plot_speed with:
    input:
        means="results/tables/mean_accuracy.csv",
    output:
        path=report(
            "results/figures/speed.{format}",
            caption="../report/figures/speed.rst",
            category="6 Speed and accuracy",
            labels={"result": "speed against accuracy", "kind": "figure"},
        ),
    log:
        "results/logs/plot_speed/{format}.log",
    benchmark:
        "results/benchmarks/plot_speed/{format}.tsv"
    params:
        figure="speed",
        options={
            "other_solvers": read_records(PROJECT / "resources/published/other_solvers.csv"),
        },
        source=digest("plot", figure="speed"),
    message:
        "Figure: speed against accuracy"


use rule plot_surfaces as plot_failures with:
    input:
        table="results/tables/failures.csv",
    output:
        path=report(
            "results/figures/failures.{format}",
            caption="../report/figures/failures.rst",
            category="7 Where methods fail",
            labels={"result": "where methods fail", "kind": "figure"},
        ),
    log:
        "results/logs/plot_failures/{format}.log",
    benchmark:
        "results/benchmarks/plot_failures/{format}.tsv"
    params:
        figure="failures",
        source=digest("plot", figure="failures"),
    message:
        "Figure: where methods fail"


use rule plot_surfaces as plot_local_exponent with:
    input:
        exponents="results/tables/fine_exponents.csv",
    output:
        path=report(
            "results/figures/local_exponent.{format}",
            caption="../report/figures/local_exponent.rst",
            category="8 Beyond the paper",
            labels={"result": "local exponent over X", "kind": "figure"},
        ),
    log:
        "results/logs/plot_local_exponent/{format}.log",
    benchmark:
        "results/benchmarks/plot_local_exponent/{format}.tsv"
    params:
        figure="local_exponent",
        source=digest("plot", figure="local_exponent"),
    message:
        "Figure: local exponent over X"


use rule plot_surfaces as plot_measured with:
    input:
        groups="results/ensembles/measured.nc",
        discs="results/ensembles/discs.nc",
        scaling="results/tables/measured_fits.csv",
        kinetics="results/tables/measured_kinetics.csv",
    output:
        path=report(
            "results/figures/measured.{format}",
            caption="../report/figures/measured.rst",
            category="8 Beyond the paper",
            labels={"result": "measured surfaces", "kind": "figure"},
        ),
    log:
        "results/logs/plot_measured/{format}.log",
    benchmark:
        "results/benchmarks/plot_measured/{format}.tsv"
    params:
        figure="measured",
        options={
            "conventions": SHOWN,
            "fraction_min": config["scaling"]["fraction_min"],
        },
        source=digest("plot", figure="measured"),
    message:
        "Figure: measured surfaces"


# ---- targets


rule figures:
    """The figures of the page, except the figure of measured surfaces."""
    input:
        expand(
            "results/figures/{figure}.png",
            figure=[
                "fig1_surfaces",
                "fig2_kinetics",
                "fig3_master_curve",
                "fig4_exponent",
                "regions",
                "direct",
                "mdr_lambda",
                "validation",
                "speed",
                "failures",
            ],
        ),


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
