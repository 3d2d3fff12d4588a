# Every method against exact solutions; `all` requires that all of them are met.


rule validate:
    output:
        csv="results/tables/validation.csv",
        nc="results/tables/validation.nc",
    log:
        "results/logs/validate.log",
    benchmark:
        "results/benchmarks/validate.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **config["validation"],
    message:
        "Comparison with exact solutions"
    script:
        "../scripts/validate.py"


rule check_validation:
    input:
        table=rules.validate.output.csv,
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
