# Self-affine discs. Lines are generated inside the jobs that indent them.


rule generate_discs:
    output:
        surfaces=temp("results/surfaces/discs/{case}/{batch}.nc"),
    log:
        "results/logs/generate_discs/{case}/{batch}.log",
    benchmark:
        "results/benchmarks/generate_discs/{case}/{batch}.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=disc_memory,
    params:
        source_digest("generate_discs"),
        seed=config["seed"],
        spawn_key=of_disc("spawn_key"),
        realizations=realizations,
        elements=of_disc("elements"),
        surface=of_disc("surface"),
    message:
        "Discs {wildcards.case}, realizations {wildcards.batch}"
    script:
        "../scripts/generate_discs.py"


rule generate_example_discs:
    output:
        surfaces="results/surfaces/examples.nc",
    log:
        "results/logs/generate_example_discs.log",
    benchmark:
        "results/benchmarks/generate_example_discs.tsv"
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=disc_memory,
    params:
        source_digest("generate_example_discs"),
        **example_discs(),
        seed=config["seed"],
        elements=config["discs"]["elements"],
    message:
        "Examples of discs"
    script:
        "../scripts/generate_example_discs.py"
