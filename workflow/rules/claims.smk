# Verdicts on what the paper says.


rule judge_claims:
    input:
        discs=ensembles("base"),
        lines=lines_of_discs(),
        scaling=rules.fit_scaling.output.csv,
        validation=rules.validate.output.csv,
    output:
        csv=report(
            "results/tables/claims.csv",
            caption="../report/claims.rst",
            category="Verdicts",
            labels={"table": "verdicts on the paper's claims"},
        ),
        nc="results/tables/claims.nc",
        verdicts="results/tables/claims.md",
    log:
        "results/logs/judge_claims.log",
    benchmark:
        "results/benchmarks/judge_claims.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=2000,
    params:
        source_digest("judge_claims"),
        claims=paper("claims"),
        shown=config["figures"],
        across=config["discs"]["elements"],
        limits={name: config["scaling"][name] for name in ("elements_min", "stiffness_max", "slope_max")},
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
    message:
        "Verdicts on the paper's claims"
    script:
        "../scripts/judge_claims.py"


rule compare_prefactors:
    input:
        scaling=rules.fit_scaling.output.csv,
    output:
        csv=report(
            "results/tables/prefactors.csv",
            caption="../report/prefactors_table.rst",
            category="Verdicts",
            labels={"table": "zeta under every convention"},
        ),
        nc="results/tables/prefactors.nc",
        png=report(
            "results/figures/prefactors.png",
            caption="../report/prefactors.rst",
            category="Verdicts",
            labels={"figure": "zeta under every convention"},
        ),
        pdf="results/figures/prefactors.pdf",
    log:
        "results/logs/compare_prefactors.log",
    benchmark:
        "results/benchmarks/compare_prefactors.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        source_digest("compare_prefactors"),
        shown=config["figures"],
    message:
        "Prefactor under every convention"
    script:
        "../scripts/compare_prefactors.py"
