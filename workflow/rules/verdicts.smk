# The rule for the verdicts on the claims of the paper.


rule judge_claims:
    """Verdicts on the claims of the paper."""
    input:
        discs="results/ensembles/discs.nc",
        tables=[
            "results/tables/scaling.csv",
            "results/tables/direct.csv",
            "results/tables/mdr_summary.csv",
            "results/tables/mdr_exponents.csv",
            "results/tables/local_slope.csv",
            "results/tables/zeta_laws.csv",
        ],
    output:
        csv="results/tables/claims.csv",
        verdicts="results/tables/claims.md",
    log:
        "results/logs/judge_claims.log",
    benchmark:
        "results/benchmarks/judge_claims.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        numbers=NUMBERS,
        fine_grids=judged_rows(PROJECT),
        reduction=read_records(PROJECT / "resources/published/reduction.csv"),
        conventions=SHOWN,
        across=config["discs"]["elements"],
        limits=without("scaling", "stiffness_range", "resamples"),  # limits of region (b)
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
        source=digest("judge_claims"),
    message:
        "Verdicts on the claims of the paper"
    script:
        "../scripts/judge_claims.py"
