# Rules for the fits that the verdicts and the figures of the paper need: β and ζ of every ensemble, λ of lines matched
# to discs, and the interface. workflow/results.yaml has further tables, among them the fits on grids from coarse to
# fine.


rule fit_power_laws:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv="results/tables/scaling.csv",
        nc="results/tables/scaling.nc",
    log:
        "results/logs/fit_power_laws.log",
    benchmark:
        "results/benchmarks/fit_power_laws.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **config["scaling"],
        seed=config["seed"],
    message:
        "Power laws in region (b): exponent beta, prefactor zeta, and lambda"
    script:
        "../scripts/fit_power_laws.py"


rule match_lambda:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv=expand("results/tables/{table}.csv", table=REGISTRY.table_rules["match_lambda"]["tables"]),
        nc=expand("results/tables/{table}.nc", table=REGISTRY.table_rules["match_lambda"]["tables"]),
    log:
        "results/logs/match_lambda.log",
    benchmark:
        "results/benchmarks/match_lambda.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        fit=config["scaling"],
        conventions=chosen("figures", "rms_convention", "average"),
        seed=config["seed"],
    message:
        "Lines that represent discs: lambda, and its residual error"
    script:
        "../scripts/match_lambda.py"


rule fit_interface:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        size_discs="results/ensembles/size_discs.nc",
        size_lines="results/ensembles/size_lines.nc",
    output:
        csv=expand("results/tables/{table}.csv", table=REGISTRY.table_rules["fit_interface"]["tables"]),
        nc=expand("results/tables/{table}.nc", table=REGISTRY.table_rules["fit_interface"]["tables"]),
    log:
        "results/logs/fit_interface.log",
    benchmark:
        "results/benchmarks/fit_interface.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        fit={
            **config["interface"],
            **chosen("scaling", "fraction_min", "resamples"),
            "seed": config["seed"],
        },
        rms_convention=config["figures"]["rms_convention"],
    message:
        "Interface and punch in series"
    script:
        "../scripts/fit_interface.py"
