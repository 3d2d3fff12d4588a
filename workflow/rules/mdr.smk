# The reduction of dimensionality against boundary elements: ensembles of lines and discs, and surface by surface.


rule match_lines:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv="results/tables/mdr_lambda.csv",
        html=report(
            "results/tables/mdr_lambda.html",
            caption="../report/mdr_lambda_table.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, lambda over the force", "kind": "table"},
        ),
        nc="results/tables/mdr_lambda.nc",
        summary_csv="results/tables/mdr_summary.csv",
        summary_html=report(
            "results/tables/mdr_summary.html",
            caption="../report/mdr_summary.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, what one lambda leaves over", "kind": "table"},
        ),
        summary_nc="results/tables/mdr_summary.nc",
        exponents_csv="results/tables/mdr_exponents.csv",
        exponents_html=report(
            "results/tables/mdr_exponents.html",
            caption="../report/mdr_exponents.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, exponents in equal windows", "kind": "table"},
        ),
        exponents_nc="results/tables/mdr_exponents.nc",
    log:
        "results/logs/match_lines.log",
    benchmark:
        "results/benchmarks/match_lines.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=4000,
    params:
        seed=config["seed"],
        fit=config["scaling"],
        conventions={name: config["figures"][name] for name in ("rms_convention", "average")},
    message:
        "Lines that stand for discs: lambda, and what it leaves over"
    script:
        "../scripts/match_lines.py"


rule plot_mdr_lambda:
    input:
        of_lambda=rules.match_lines.output.csv,
        exponents=rules.match_lines.output.exponents_csv,
    output:
        png=report(
            "results/figures/mdr_lambda.png",
            caption="../report/mdr_lambda.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, lambda and exponents", "kind": "figure"},
        ),
        pdf="results/figures/mdr_lambda.pdf",
    log:
        "results/logs/plot_mdr_lambda.log",
    benchmark:
        "results/benchmarks/plot_mdr_lambda.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure of lambda and of exponents in equal windows"
    script:
        "../scripts/plot_mdr_lambda.py"


rule compare_reduction:
    output:
        csv="results/tables/reduction.csv",
        html=report(
            "results/tables/reduction.html",
            caption="../report/reduction_table.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, surface by surface", "kind": "table"},
        ),
        nc="results/tables/reduction.nc",
    log:
        "results/logs/compare_reduction.log",
    benchmark:
        "results/benchmarks/compare_reduction.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        **config["reduction"],
        hurst=config["discs"]["hurst"],
        elements=config["discs"]["elements"],
        realizations=config["discs"]["realizations"],
        tolerance=config["discs"]["tolerance"],
        seed=config["seed"],
    message:
        "Reduction of dimensionality against boundary elements, surface by surface"
    script:
        "../scripts/compare_reduction.py"


rule plot_reduction:
    input:
        table=rules.compare_reduction.output.csv,
    output:
        png=report(
            "results/figures/reduction.png",
            caption="../report/reduction.rst",
            category=chapter("verdicts"),
            labels={"result": "MDR, surface by surface", "kind": "figure"},
        ),
        pdf="results/figures/reduction.pdf",
    log:
        "results/logs/plot_reduction.log",
    benchmark:
        "results/benchmarks/plot_reduction.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    message:
        "Figure of the reduction of dimensionality against boundary elements"
    script:
        "../scripts/plot_reduction.py"
