# Other media than the paper's: the same loading curves, read with another creep compliance.


rule compute_media:
    input:
        curves=curves_of_combinations(),
    output:
        csv="results/tables/media.csv",
        nc="results/tables/media.nc",
        exponents_csv="results/tables/media_exponents.csv",
        exponents_nc="results/tables/media_exponents.nc",
    log:
        "results/logs/compute_media.log",
    benchmark:
        "results/benchmarks/compute_media.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        **config["media"],
        **{name: config["scaling"][name] for name in ("stiffness_range", "resamples")},
        rms_convention=config["figures"]["rms_convention"],
        discs=cases.first_combination(config),
        until_x=config["indentation"]["until_x"],
        seed=config["seed"],
    message:
        "Kinetics in other media"
    script:
        "../scripts/compute_media.py"
