# Rules that tabulate the time and memory of all rules. Like all measured times, these times differ from run to run.

# Rules in the tables of costs: all rules of the files included before this file. Rules that need scans are left out if
# the settings name no scan.
NEED_SCANS = [rules.press_measured.rule, rules.evaluate_measured.rule, rules.plot_measured.rule]
COUNTED = [member for member in own_rules() if MEASURED or member not in NEED_SCANS]


rule tabulate_rule_costs:
    input:
        rules.figures.input,
        rules.tables.input,
        rules.validation.input,
        rules.measured.input,
    output:
        csv="results/tables/rule_costs.csv",
        nc="results/tables/rule_costs.nc",
    log:
        "results/logs/tabulate_rule_costs.log",
    benchmark:
        "results/benchmarks/tabulate_rule_costs.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=500,
    params:
        benchmarks=lambda wildcards: {"compile_kernels": [KERNELS_BENCHMARK]} | benchmark_files(COUNTED),
    message:
        "Time and memory of every rule"
    script:
        "../scripts/tabulate_rule_costs.py"


rule costs:
    """Time and memory of every rule."""
    input:
        rules.tabulate_rule_costs.output,
