# Cost of the rules, which differs from run to run, as do all measured times.


rule tabulate_rule_costs:
    input:
        rules.figures.input,
        rules.tables.input,
        rules.validation.input,
        rules.measured.input,
    output:
        csv="results/tables/rule_costs.csv",
        nc="results/tables/rule_costs.nc",
    localrule: True
    resources:
        mem_mb=500,
    params:
        benchmarks="results/benchmarks",
    message:
        "Time and memory of every rule"
    script:
        "../scripts/tabulate_rule_costs.py"


rule costs:
    """Time and memory of every rule."""
    input:
        rules.tabulate_rule_costs.output,
