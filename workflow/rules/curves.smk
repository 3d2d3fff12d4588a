# Rules that compute elastic loading curves: of surfaces by boundary elements, of lines by the method of dimensionality
# reduction. A further rule makes ensembles: it brings the realizations of all cases in a pool to common abscissae.


# A disc is generated in the same job that indents it, and not stored: all discs of the default run would take 1.6 GB.
rule indent_discs:
    output:
        curves="results/curves/discs/{case}/{batch}.nc",
    log:
        "results/logs/indent_discs/{case}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_discs/{case}/{batch}.tsv"
    priority: 1  # start these long jobs early; at the end, short jobs then share the cores evenly
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.disc_memory(DISCS[wildcards.case]),
    params:
        ensembles=lambda wildcards: batch_ensembles(DISCS, wildcards.case, wildcards.batch),
        seed=config["seed"],
        indentation=lambda wildcards: DISCS[wildcards.case]["indentation"],
        source=digest("indent_discs"),
    message:
        "Boundary elements, discs {wildcards.case}, realizations {wildcards.batch}"
    script:
        "../scripts/indent_discs.py"


rule indent_measured:
    input:
        # These files are temporary and usually missing, but this rule must be rerun when the rule that makes them has
        # changed. If they were marked as ancient, existing files would not cause a rerun, and Snakemake would end
        # without an error and without the dependent results.
        surfaces="results/surfaces/measured/{scan}/{batch}.nc",
    output:
        curves="results/curves/measured/{scan}/{batch}.nc",
    log:
        "results/logs/indent_measured/{scan}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_measured/{scan}/{batch}.tsv"
    priority: 2  # indent a surface before the next surface is prepared, which frees its disk space
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.measured_memory(MEASURED[wildcards.scan]),
    params:
        indentation=scan_value("indentation"),
        source=digest("indent_measured"),
    message:
        "Boundary elements, measured surface {wildcards.scan}"
    script:
        "../scripts/indent_measured.py"


# A line is generated in the same job that reduces it, and not stored: a line of 4 000 000 points takes 16 MB.
rule reduce_lines:
    output:
        curves="results/curves/lines/{line}/{batch}.nc",
    log:
        "results/logs/reduce_lines/{line}/{batch}.log",
    benchmark:
        "results/benchmarks/reduce_lines/{line}/{batch}.tsv"
    priority: 2  # before the discs, so that the lines are aggregated while discs are indented
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.line_memory(LINES[wildcards.line]),
    params:
        ensembles=lambda wildcards: batch_ensembles(LINES, wildcards.line, wildcards.batch),
        seed=config["seed"],
        until_x=lambda wildcards: LINES[wildcards.line]["until_x"],
        source=digest("reduce_lines"),
    message:
        "Reduction of dimensionality, lines {wildcards.line}, realizations {wildcards.batch}"
    script:
        "../scripts/reduce_lines.py"


# The same discs on two neighbouring grids. They are generated in the job that indents them: a disc of 4097 x 4097
# elements takes 134 MB.
rule indent_nested:
    output:
        curves="results/curves/nested/{nested}.nc",
    log:
        "results/logs/indent_nested/{nested}.log",
    benchmark:
        "results/benchmarks/indent_nested/{nested}.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.nested_memory(NESTED[wildcards.nested]),
    params:
        case=lambda wildcards: NESTED[wildcards.nested],
        tolerance=config["nested_grids"]["tolerance"],
        seed=config["seed"],
        source=digest("indent_nested"),
    message:
        "Boundary elements on two neighbouring grids, {wildcards.nested}"
    script:
        "../scripts/indent_nested.py"


rule aggregate_curves:
    input:
        curves=lambda wildcards: cases.pool_curves(CASES, wildcards.pool),
    output:
        pool="results/ensembles/{pool}.nc",
    log:
        "results/logs/aggregate_curves/{pool}.log",
    benchmark:
        "results/benchmarks/aggregate_curves/{pool}.tsv"
    priority: 1
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.pool_memory(CASES, wildcards.pool, config["ensemble"]),
    params:
        groups=lambda wildcards: cases.pool_groups(CASES, wildcards.pool),
        conventions=lambda wildcards: cases.POOLS[wildcards.pool],
        ensemble=config["ensemble"],
        source=digest("aggregate_curves"),
    message:
        "Realizations on common abscissae: {wildcards.pool}"
    script:
        "../scripts/aggregate_curves.py"


rule curves:
    """The loading curves of the discs and lines of Figures 2 to 4, and of their variants."""
    input:
        cases.pool_curves(CASES, "discs"),
        cases.pool_curves(CASES, "lines"),
