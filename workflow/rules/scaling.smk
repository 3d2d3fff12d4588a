# Region (b), exponents beta, prefactors zeta and lambda.


rule fit_scaling:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv=report(
            "results/tables/scaling.csv",
            caption="../report/scaling.rst",
            category="Tables",
            labels={"table": "power laws in region (b)"},
        ),
        nc="results/tables/scaling.nc",
    log:
        "results/logs/fit_scaling.log",
    benchmark:
        "results/benchmarks/fit_scaling.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=4000,
    params:
        seed=config["seed"],
        fit=config["scaling"],
    message:
        "Power laws in region (b)"
    script:
        "../scripts/fit_scaling.py"


rule tabulate_calibration:
    input:
        scaling=rules.fit_scaling.output.csv,
    output:
        csv=report(
            "results/tables/calibration.csv",
            caption="../report/calibration.rst",
            category="Tables",
            labels={"table": "calibrated exponents and prefactors"},
        ),
        nc="results/tables/calibration.nc",
    log:
        "results/logs/tabulate_calibration.log",
    benchmark:
        "results/benchmarks/tabulate_calibration.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
    message:
        "Calibrated exponents and prefactors"
    script:
        "../scripts/tabulate_calibration.py"
