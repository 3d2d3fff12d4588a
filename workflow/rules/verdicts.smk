# Rules for two verdicts: on the comparison with exact solutions, which must pass for `all`, and on the claims of the
# paper.


rule check_validation:
    input:
        table="results/tables/validation.csv",
    output:
        passed="results/tables/validation_passed.txt",
    log:
        "results/logs/check_validation.log",
    benchmark:
        "results/benchmarks/check_validation.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=500,
    params:
        order_margin=config["validation"]["order_margin"],
    message:
        "Verdict on the comparison with exact solutions"
    script:
        "../scripts/check_validation.py"


# Names of the tables that decide about the claims.
EVIDENCE = ("scaling", "validation", "direct", "reduction", "mdr_summary", "mdr_exponents", "plateaus", "zeta_laws")
EVIDENCE += ("methods", "sizes", "grid_dependence", "histories")


rule judge_claims:
    input:
        tables=expand("results/tables/{table}.csv", table=EVIDENCE),
        discs="results/ensembles/discs.nc",
    output:
        csv="results/tables/claims.csv",
        nc="results/tables/claims.nc",
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
        rules=config["verdicts"],
        conventions=config["figures"],
        surfaces=cases.surfaces_left_open(config),
        across=config["discs"]["elements"],
        limits=without("scaling", "stiffness_range", "resamples"),  # limits of region (b)
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
    message:
        "Verdicts on the claims of the paper"
    script:
        "../scripts/judge_claims.py"
