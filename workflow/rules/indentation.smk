# Rules that compute elastic loading curves: of surfaces by boundary elements, of lines by the method of dimensionality
# reduction.


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
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=lambda wildcards: cases.line_memory(LINES[wildcards.line]),
    params:
        ensembles=lambda wildcards: batch_ensembles(LINES, wildcards.line, wildcards.batch),
        seed=config["seed"],
        until_x=lambda wildcards: LINES[wildcards.line]["until_x"],
    message:
        "Reduction of dimensionality, lines {wildcards.line}, realizations {wildcards.batch}"
    script:
        "../scripts/reduce_lines.py"
