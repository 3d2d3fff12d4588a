# Rules that compute elastic loading curves: of surfaces by boundary elements, of lines by the method of dimensionality
# reduction. A further rule makes ensembles: it brings the realizations of all samples in a pool to common abscissae.


rule indent_surfaces:
    """Loading curves of a batch of discs, or of a measured surface, by boundary elements."""
    input:
        # These files are temporary and usually missing, but this rule must be rerun when the rule that makes them has
        # changed. If they were marked as ancient, existing files would not cause a rerun, and Snakemake would end
        # without an error and without the dependent results.
        surfaces="results/surfaces/{kind}/{sample}/{batch}.nc",
    output:
        curves="results/curves/{kind}/{sample}/{batch}.nc",
    log:
        "results/logs/indent_surfaces/{kind}/{sample}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_surfaces/{kind}/{sample}/{batch}.tsv"
    priority: 2  # indent the surfaces of a batch before the next batch is generated, which frees their disk space
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=indentation_memory,
    params:
        indentation=lambda wildcards: SAMPLES[wildcards.kind][wildcards.sample]["indentation"],
        source=lambda wildcards: [digest("indent_surfaces"), surfaces_origin(wildcards)],
    message:
        "Boundary elements, {wildcards.kind} {wildcards.sample}, realizations {wildcards.batch}"
    script:
        "../scripts/indent_surfaces.py"


# A line is generated in the same job that reduces it, and not stored: a line of 4 000 000 points takes 16 MB.
rule reduce_lines:
    """Loading curves of a batch of lines, by reduction of dimensionality."""
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
        mem_mb=lambda wildcards: samples.line_memory(LINES[wildcards.line]),
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
    """Loading curves of a batch of discs on several grids."""
    output:
        curves="results/curves/nested/{nested}/{batch}.nc",
    log:
        "results/logs/indent_nested/{nested}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_nested/{nested}/{batch}.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards, attempt: attempt * samples.nested_memory(NESTED[wildcards.nested]),
    params:
        sample=lambda wildcards: samples.nested_arguments(NESTED[wildcards.nested], wildcards.batch),
        tolerance=config["curves"]["tolerance"],
        seed=config["seed"],
        source=digest("indent_nested"),
    message:
        "Boundary elements on several grids, {wildcards.nested}, discs {wildcards.batch}"
    script:
        "../scripts/indent_nested.py"


rule aggregate_curves:
    """All curves of a pool on common abscissae."""
    input:
        curves=lambda wildcards: samples.pool_curves(SAMPLES, wildcards.pool),
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
        mem_mb=lambda wildcards: samples.pool_memory(SAMPLES, wildcards.pool, config["curves"]),
    params:
        groups=lambda wildcards: samples.pool_groups(SAMPLES, wildcards.pool),
        conventions=lambda wildcards: samples.POOLS[wildcards.pool],
        ensemble=chosen("curves", "x_low", "per_decade") | {"x_high": config["curves"]["until_x"]},
        source=digest("aggregate_curves"),
    message:
        "Realizations on common abscissae: {wildcards.pool}"
    script:
        "../scripts/aggregate_curves.py"


rule curves:
    """The loading curves of the discs and lines of Figures 2 to 4."""
    input:
        samples.pool_curves(SAMPLES, "discs"),
        samples.pool_curves(SAMPLES, "lines"),
