# Rules that compare: methods with exact solutions and with each other, models of one surface with boundary elements,
# and measured surfaces.


rule tabulate_validation:
    """Comparison with exact solutions."""
    output:
        csv="results/tables/validation.csv",
    log:
        "results/logs/tabulate_validation.log",
    benchmark:
        "results/benchmarks/tabulate_validation.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **without("validation", "direct"),
        source=digest("tabulate_validation"),
    message:
        "Comparison with exact solutions"
    script:
        "../scripts/tabulate_validation.py"


rule require_validation:
    """End the run unless all comparisons with exact solutions have passed."""
    input:
        table="results/tables/validation.csv",
    output:
        passed="results/tables/validation_passed.txt",
    log:
        "results/logs/require_validation.log",
    benchmark:
        "results/benchmarks/require_validation.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=500,
    params:
        order_margin=config["validation"]["order_margin"],
        source=digest("require_validation"),
    message:
        "Verdict on the comparison with exact solutions"
    script:
        "../scripts/require_validation.py"


rule compare_direct:
    """Direct integration against both readings of the law."""
    output:
        csv="results/tables/direct.csv",
    log:
        "results/logs/compare_direct.log",
    benchmark:
        "results/benchmarks/compare_direct.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        **config["validation"]["direct"],
        hursts=config["hurst"],
        seed=config["seed"],
        source=digest("compare_direct"),
    message:
        "Direct integration against both readings of the law"
    script:
        "../scripts/compare_direct.py"


rule map_failures:
    """Every method in every stress test."""
    output:
        csv="results/tables/failures.csv",
    log:
        "results/logs/map_failures.log",
    benchmark:
        "results/benchmarks/map_failures.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **config["methods"]["stress"],
        hurst_min=NUMBERS["agreement"]["beta_hurst_min"]["value"],
        seed=config["seed"],
        source=digest("map_failures"),
    message:
        "Every method in every stress test"
    script:
        "../scripts/map_failures.py"


# Settings that determine the contacts of a measured surface. The digest changes with the content of its file.
PRESSED = ("group", "file", "digest", "spacing", "unit", "preparation", "forces", "young_modulus", "poisson_ratio")


rule solve_measured_contacts:
    """Contacts of measured surfaces."""
    output:
        csv="results/tables/measured_contacts.csv",
    log:
        "results/logs/solve_measured_contacts.log",
    benchmark:
        "results/benchmarks/solve_measured_contacts.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        scans=[{"name": name} | {key: scan[key] for key in PRESSED} for name, scan in MEASURED.items()],
        source=digest("solve_measured_contacts"),
    message:
        "Contacts of measured surfaces"
    script:
        "../scripts/solve_measured_contacts.py"


rule evaluate_measured:
    """Power laws and kinetics of measured surfaces."""
    input:
        pool="results/ensembles/measured.nc",
        curves=samples.pool_curves(SAMPLES, "measured"),
    output:
        csv=[
            "results/tables/measured_scans.csv",
            "results/tables/measured_fits.csv",
            "results/tables/measured_kinetics.csv",
        ],
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
        media=config["kinetics"]["media"],
        times=config["kinetics"]["times"],
        fit=config["scaling"],
        seed=config["seed"],
        source=digest("evaluate_measured"),
    message:
        "Power laws and kinetics of measured surfaces"
    script:
        "../scripts/evaluate_measured.py"
