# Elastic loading curves: discs by boundary elements, lines by reduction of dimensionality.


rule indent_discs:
    input:
        surfaces=rules.generate_discs.output.surfaces,
    output:
        curves="results/curves/discs/{case}/{batch}.nc",
    log:
        "results/logs/indent_discs/{case}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_discs/{case}/{batch}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=disc_memory,
    params:
        source_digest("indent_discs"),
        **config["indentation"],
    message:
        "Boundary elements, discs {wildcards.case}, realizations {wildcards.batch}"
    script:
        "../scripts/indent_discs.py"


rule indent_lines:
    output:
        curves="results/curves/lines/{line}/{batch}.nc",
    log:
        "results/logs/indent_lines/{line}/{batch}.log",
    benchmark:
        "results/benchmarks/indent_lines/{line}/{batch}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=line_memory,
    params:
        source_digest("indent_lines"),
        seed=config["seed"],
        spawn_key=of_line("spawn_key"),
        realizations=realizations,
        points=of_line("points"),
        surface=of_line("surface"),
        until_x=config["indentation"]["until_x"],
    message:
        "Reduction of dimensionality, lines {wildcards.line}, realizations {wildcards.batch}"
    script:
        "../scripts/indent_lines.py"
