# The reduction of dimensionality against boundary elements: ensembles of lines and discs, and surface by surface.


rule match_lines:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv="results/tables/mdr_lambda.csv",
        nc="results/tables/mdr_lambda.nc",
        summary_csv="results/tables/mdr_summary.csv",
        summary_nc="results/tables/mdr_summary.nc",
        exponents_csv="results/tables/mdr_exponents.csv",
        exponents_nc="results/tables/mdr_exponents.nc",
    log:
        "results/logs/match_lines.log",
    benchmark:
        "results/benchmarks/match_lines.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        seed=config["seed"],
        fit=config["scaling"],
        conventions={name: config["figures"][name] for name in ("rms_convention", "average")},
    message:
        "Lines that stand for discs: lambda, and its residual error"
    script:
        "../scripts/match_lines.py"


rule compare_reduction:
    output:
        csv="results/tables/reduction.csv",
        nc="results/tables/reduction.nc",
    log:
        "results/logs/compare_reduction.log",
    benchmark:
        "results/benchmarks/compare_reduction.tsv"
    conda:
        "../envs/viscorough.yaml"
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
