# Rules that fit ensembles: β and ζ of every ensemble, λ of lines matched to discs, the local slope within region (b), and
# the exponents on fine grids.


rule fit_scaling:
    """Power laws in region (b): exponent beta and prefactor zeta."""
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv="results/tables/scaling.csv",
    log:
        "results/logs/fit_scaling.log",
    benchmark:
        "results/benchmarks/fit_scaling.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **without("scaling", "stiffness_range"),
        seed=config["seed"],
        source=digest("fit_scaling"),
    message:
        "Power laws in region (b): exponent beta and prefactor zeta"
    script:
        "../scripts/fit_scaling.py"


rule match_mdr:
    """Lines that represent discs: lambda, and its residual error."""
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv=["results/tables/mdr_lambda.csv", "results/tables/mdr_summary.csv", "results/tables/mdr_exponents.csv"],
    log:
        "results/logs/match_mdr.log",
    benchmark:
        "results/benchmarks/match_mdr.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        fit=config["scaling"],
        conventions={name: SHOWN[name] for name in ("rms_convention", "average")},
        seed=config["seed"],
        source=digest("match_mdr"),
    message:
        "Lines that represent discs: lambda, and its residual error"
    script:
        "../scripts/match_mdr.py"


rule fit_local_slope:
    """Local slope within region (b), of the discs and of a control."""
    input:
        discs="results/ensembles/discs.nc",
    output:
        csv="results/tables/local_slope.csv",
    log:
        "results/logs/fit_local_slope.log",
    benchmark:
        "results/benchmarks/fit_local_slope.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        region=without("scaling", "stiffness_range", "resamples"),
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
        source=digest("fit_local_slope"),
    message:
        "Local slope within region (b), of the discs and of a control"
    script:
        "../scripts/fit_local_slope.py"


rule compare_zeta_laws:
    """Laws of the prefactor by one measure."""
    input:
        discs="results/ensembles/discs.nc",
    output:
        csv="results/tables/zeta_laws.csv",
    log:
        "results/logs/compare_zeta_laws.log",
    benchmark:
        "results/benchmarks/compare_zeta_laws.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        average=SHOWN["average"],
        hurst_mins=[0.0, NUMBERS["agreement"]["beta_hurst_min"]["value"]],
        fit=without("scaling", "resamples"),
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
        source=digest("compare_zeta_laws"),
    message:
        "Laws of the prefactor by one measure"
    script:
        "../scripts/compare_zeta_laws.py"


rule fit_fine_exponents:
    """Exponents of small X on fine grids, and their limits."""
    input:
        curves=lambda wildcards: fine_curves(),
    output:
        csv="results/tables/fine_exponents.csv",
    log:
        "results/logs/fit_fine_exponents.log",
    benchmark:
        "results/benchmarks/fit_fine_exponents.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        elements_min=config["fine_grids"]["elements_min"],
        seed=config["seed"],
        source=digest("fit_fine_exponents"),
    message:
        "Exponents of small X on fine grids, and their limits"
    script:
        "../scripts/fit_fine_exponents.py"
