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
    threads: 1
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
        scans=table_files("measured_scans", "../report/measured_scans.rst", "measured surfaces"),
        fits=table_files("measured_fits", "../report/measured_fits.rst", "power laws of measured surfaces"),
        kinetics=table_files("measured_kinetics", "../report/measured_kinetics.rst", "kinetics of measured surfaces"),
    log:
        "results/logs/evaluate_measured.log",
    benchmark:
        "results/benchmarks/evaluate_measured.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
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


rule plot_measured:
    input:
        pool="results/ensembles/measured.nc",
        discs="results/ensembles/discs.nc",
        fits=lambda wildcards: rules.evaluate_measured.output.fits[0],
        kinetics=lambda wildcards: rules.evaluate_measured.output.kinetics[0],
    output:
        png=report(
            "results/figures/measured.png",
            caption="../report/measured.rst",
            category=chapter("beyond"),
            labels={"result": "measured surfaces", "kind": "figure"},
        ),
        pdf="results/figures/measured.pdf",
    log:
        "results/logs/plot_measured.log",
    benchmark:
        "results/benchmarks/plot_measured.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        conventions=config["figures"],
        fraction_min=config["scaling"]["fraction_min"],
    message:
        "Figure of measured surfaces"
    script:
        "../scripts/plot_measured.py"
