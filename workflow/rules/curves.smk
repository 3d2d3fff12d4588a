# Rules that compute elastic loading curves: of surfaces by boundary elements, of lines by the method of dimensionality
# reduction. A further rule makes ensembles: it brings the realizations of all cases in a pool to common abscissae.


rule indent_surfaces:
    input:
        # These files are temporary and usually missing, but this rule must be rerun when the rule that makes them has
        # changed. If they were marked as ancient, existing files would not cause a rerun, and Snakemake would end
        # without an error and without the dependent results.
        surfaces="results/surfaces/{kind}/{case}/{batch}.nc",
    output:
        curves="results/curves/{kind}/{case}/{batch}.nc",
    log:
        "results/logs/indent_surfaces/{kind}/{case}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_surfaces/{kind}/{case}/{batch}.tsv"
    priority: 2  # indent the surfaces of a batch before the next batch is generated, which frees their disk space
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=indentation_memory,
    params:
        indentation=lambda wildcards: CASES[wildcards.kind][wildcards.case]["indentation"],
        source=lambda wildcards: [digest("indent_surfaces"), surfaces_origin(wildcards)],
    message:
        "Boundary elements, {wildcards.kind} {wildcards.case}, realizations {wildcards.batch}"
    script:
        "../scripts/indent_surfaces.py"


# A line is generated in the same job that reduces it, and not stored: a line of 4 000 000 points takes 16 MB.
rule reduce_lines:
    output:
        curves="results/curves/lines/{line}/{batch}.nc",
    log:
        "results/logs/reduce_lines/{line}/{batch}.log",
    benchmark:
        "results/benchmarks/reduce_lines/{line}/{batch}.tsv"
    priority: 1  # as for discs, so that the lines are aggregated while the last discs are indented
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


# The same discs on several grids. They are generated in the job that indents them: a disc of 4097 x 4097 elements takes
# 134 MB.
rule indent_nested:
    output:
        curves="results/curves/nested/{nested}/{batch}.nc",
    log:
        "results/logs/indent_nested/{nested}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_nested/{nested}/{batch}.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards, attempt: attempt * cases.nested_memory(NESTED[wildcards.nested]),
    params:
        case=lambda wildcards: cases.nested_arguments(NESTED[wildcards.nested], wildcards.batch),
        tolerance=config["curves"]["tolerance"],
        seed=config["seed"],
        source=digest("indent_nested"),
    message:
        "Boundary elements on several grids, {wildcards.nested}, discs {wildcards.batch}"
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
        mem_mb=lambda wildcards: cases.pool_memory(CASES, wildcards.pool, config["curves"]),
    params:
        groups=lambda wildcards: cases.pool_groups(CASES, wildcards.pool),
        conventions=lambda wildcards: cases.POOLS[wildcards.pool],
        ensemble=chosen("curves", "x_low", "per_decade") | {"x_high": config["curves"]["until_x"]},
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
