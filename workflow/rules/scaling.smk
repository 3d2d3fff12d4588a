# Region (b), exponents beta, prefactors zeta and lambda.


rule fit_scaling:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv="results/tables/scaling.csv",
        nc="results/tables/scaling.nc",
    log:
        "results/logs/fit_scaling.log",
    benchmark:
        "results/benchmarks/fit_scaling.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
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
        sizes="results/tables/sizes.csv",
    output:
        csv="results/tables/calibration.csv",
        nc="results/tables/calibration.nc",
    log:
        "results/logs/tabulate_calibration.log",
    benchmark:
        "results/benchmarks/tabulate_calibration.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
        across=config["discs"]["elements"],
    message:
        "Calibrated exponents and prefactors"
    script:
        "../scripts/tabulate_calibration.py"
