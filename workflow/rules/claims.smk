# Verdicts on the claims of the paper, and the comparisons that they rest on.


rule compare_direct:
    output:
        csv="results/tables/direct.csv",
        nc="results/tables/direct.nc",
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
        **config["direct"],
        hursts=config["discs"]["hurst"],
        seed=config["seed"],
    message:
        "Direct integration against both readings of the law"
    script:
        "../scripts/compare_direct.py"


rule measure_plateaus:
    input:
        discs="results/ensembles/discs.nc",
    output:
        csv="results/tables/plateaus.csv",
        nc="results/tables/plateaus.nc",
    log:
        "results/logs/measure_plateaus.log",
    benchmark:
        "results/benchmarks/measure_plateaus.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        **plateau_settings(),
    message:
        "Decades over which the slope is constant"
    script:
        "../scripts/measure_plateaus.py"


rule compare_prefactors:
    input:
        scaling=rules.fit_scaling.output.csv,
    output:
        csv="results/tables/prefactors.csv",
        nc="results/tables/prefactors.nc",
    log:
        "results/logs/compare_prefactors.log",
    benchmark:
        "results/benchmarks/compare_prefactors.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        surfaces=cases.surface_conventions(config),
    message:
        "Prefactor under every convention"
    script:
        "../scripts/compare_prefactors.py"


rule compare_zeta_laws:
    input:
        discs="results/ensembles/discs.nc",
    output:
        csv="results/tables/zeta_laws.csv",
        nc="results/tables/zeta_laws.nc",
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
        conventions={name: config["figures"][name] for name in ("average", "rms_convention")},
        hurst_mins=[0.0, number(paper("numbers"), "agreement", "beta_hurst_min")],
        fit={name: value for name, value in config["scaling"].items() if name != "resamples"},
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
    message:
        "Laws of the prefactor by one measure"
    script:
        "../scripts/compare_zeta_laws.py"


rule judge_claims:
    input:
        discs="results/ensembles/discs.nc",
        scaling=rules.fit_scaling.output.csv,
        validation=rules.validate.output.csv,
        direct=rules.compare_direct.output.csv,
        reduction=rules.compare_reduction.output.csv,
        mdr_summary=rules.match_lines.output.summary_csv,
        mdr_exponents=rules.match_lines.output.exponents_csv,
        plateaus=rules.measure_plateaus.output.csv,
        prefactors=rules.compare_prefactors.output.csv,
        zeta_laws=rules.compare_zeta_laws.output.csv,
        methods="results/tables/methods.csv",
        sizes="results/tables/sizes.csv",
        sizes_trends="results/tables/sizes_trends.csv",
    output:
        csv="results/tables/claims.csv",
        nc="results/tables/claims.nc",
        verdicts="results/tables/claims.md",
    log:
        "results/logs/judge_claims.log",
    benchmark:
        "results/benchmarks/judge_claims.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=2000,
    params:
        claims=paper("claims"),
        numbers=paper("numbers"),
        rules=config["verdicts"],
        conventions=config["figures"],
        across=config["discs"]["elements"],
        limits=region_limits(),
        resamples=config["scaling"]["resamples"],
        seed=config["seed"],
    message:
        "Verdicts on the claims of the paper"
    script:
        "../scripts/judge_claims.py"
