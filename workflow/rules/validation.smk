# Every method against exact solutions; `all` needs all of them to be met.


rule validate:
    output:
        csv=report(
            "results/tables/validation.csv",
            caption="../report/validation_table.rst",
            category="Tables",
            labels={"table": "comparison with exact solutions"},
        ),
        nc="results/tables/validation.nc",
    log:
        "results/logs/validate.log",
    benchmark:
        "results/benchmarks/validate.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=4000,
    params:
        source_digest("validate"),
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
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=500,
    params:
        source_digest("check_validation"),
    message:
        "Verdict on the comparison with exact solutions"
    script:
        "../scripts/check_validation.py"
