# Measured surfaces of the settings, beside the generated ones.


rule indent_measured:
    input:
        heights=of_scan("file"),
    output:
        curves="results/curves/measured/{scan}/0000-0000.nc",
    log:
        "results/logs/indent_measured/{scan}.log",
    benchmark:
        "results/benchmarks/indent_measured/{scan}.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=measured_memory,
    params:
        of_scan("digest"),
        name=lambda wildcards: wildcards.scan,
        group=of_scan("group"),
        spacing=of_scan("spacing"),
        unit=of_scan("unit"),
        preparation=of_scan("preparation"),
        indentation=config["indentation"],
    message:
        "Boundary elements, measured surface {wildcards.scan}"
    script:
        "../scripts/indent_measured.py"


rule evaluate_measured:
    input:
        pool="results/ensembles/measured.nc",
        curves=curves_of_pool("measured"),
    output:
        **{
            name: expand(f"results/tables/measured_{name}.{{kind}}", kind=("csv", "nc"))
            for name in ("scans", "fits", "kinetics")
        },
    log:
        "results/logs/evaluate_measured.log",
    benchmark:
        "results/benchmarks/evaluate_measured.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        names=list(MEASURED),
        forces=[scan["forces"] for scan in MEASURED.values()],
        media=config["media"]["cases"],
        times=config["media"]["times"],
        fit=config["scaling"],
        seed=config["seed"],
    message:
        "Power laws and kinetics of measured surfaces"
    script:
        "../scripts/evaluate_measured.py"
