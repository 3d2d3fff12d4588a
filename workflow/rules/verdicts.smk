# The rule for the verdicts on the claims of the paper.


rule judge_claims:
    input:
        discs="results/ensembles/discs.nc",
        tables=[
            "results/tables/scaling.csv",
            "results/tables/validation.csv",
            "results/tables/direct.csv",
            "results/tables/reduction.csv",
            "results/tables/mdr_summary.csv",
            "results/tables/mdr_exponents.csv",
            "results/tables/plateaus.csv",
            "results/tables/zeta_laws.csv",
            "results/tables/methods.csv",
            "results/tables/sizes.csv",
            "results/tables/grid_dependence.csv",
            "results/tables/histories.csv",
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
        claims=paper("claims"),
        numbers=paper("numbers"),
        fine_grids=judged_rows(PROJECT),
        rules=config["verdicts"],
        conventions=config["figures"],
        surfaces=cases.surfaces_left_open(config),
        across=config["discs"]["elements"],
        limits=without("scaling", "stiffness_range", "resamples"),  # limits of region (b)
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
        source=digest("judge_claims"),
    message:
        "Verdicts on the claims of the paper"
    script:
        "../scripts/judge_claims.py"
