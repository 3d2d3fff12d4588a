# Rules of what goes beyond the paper: `snakemake beyond` and `snakemake sensitivities`. No rule of the default run uses
# their results; the page of the default run shows published pictures.


rule compare_periodic:
    """The control of two springs: periodic contact of the same spectra."""
    output:
        csv="results/tables/periodic.csv",
    log:
        "results/logs/compare_periodic.log",
    benchmark:
        "results/benchmarks/compare_periodic.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=samples.grid_memory(config["beyond"]["periodic"]["points"], config["beyond"]["periodic"]["surfaces"]),
    params:
        **config["beyond"]["periodic"],
        hursts=config["hurst"],
        seed=config["seed"],
        source=digest("compare_periodic"),
    message:
        "The control of two springs: periodic contact of the same spectra"
    script:
        "../scripts/compare_periodic.py"


rule compare_reduction:
    """Reduction of dimensionality against boundary elements, surface by surface."""
    output:
        csv="results/tables/reduction.csv",
    log:
        "results/logs/compare_reduction.log",
    benchmark:
        "results/benchmarks/compare_reduction.tsv"
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=samples.grid_memory(config["discs"]["elements"]),
    params:
        **chosen("discs", "elements", "realizations"),
        **config["beyond"]["reduction"],
        tolerance=config["curves"]["tolerance"],
        hursts=config["hurst"],
        seed=config["seed"],
        source=digest("compare_reduction"),
    message:
        "Reduction of dimensionality against boundary elements, surface by surface"
    script:
        "../scripts/compare_reduction.py"


rule compare_histories:
    """Any history of loading and unloading, against direct integration."""
    output:
        csv="results/tables/histories.csv",
    log:
        "results/logs/compare_histories.log",
    benchmark:
        "results/benchmarks/compare_histories.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        hursts=config["hurst"],
        elements=config["validation"]["direct"]["elements"],
        seed=config["seed"],
        source=digest("compare_histories"),
    message:
        "Any history of loading and unloading, against direct integration"
    script:
        "../scripts/compare_histories.py"


rule compute_media:
    """Kinetics in other media."""
    input:
        curves=samples.combination_curves(DISCS),
    output:
        csv="results/tables/media.csv",
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
        **config["kinetics"],
        discs=samples.first_combination(config),
        rms_convention=SHOWN["rms_convention"],
        source=digest("compute_media"),
    message:
        "Kinetics in other media"
    script:
        "../scripts/compute_media.py"


rule fit_interface:
    """Interface and punch in series."""
    input:
        discs="results/ensembles/discs.nc",
        law="results/ensembles/law.nc",
        lines="results/ensembles/lines.nc",
    output:
        csv=["results/tables/interface.csv", "results/tables/interface_curves.csv"],
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
            **chosen("beyond", "plateau"),
            **chosen("scaling", "fraction_min", "resamples"),
            "seed": config["seed"],
        },
        source=digest("fit_interface"),
    message:
        "Interface and punch in series"
    script:
        "../scripts/fit_interface.py"


rule tabulate_literature:
    """Results in the literature."""
    input:
        scaling="results/tables/scaling.csv",
        interface="results/tables/interface.csv",
        reduction="results/tables/reduction.csv",
    output:
        csv="results/tables/literature.csv",
    log:
        "results/logs/tabulate_literature.log",
    benchmark:
        "results/benchmarks/tabulate_literature.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        entries=read_yaml("resources/literature/stiffness.yaml"),
        conventions=SHOWN,
        source=digest("tabulate_literature"),
    message:
        "Results in the literature"
    script:
        "../scripts/tabulate_literature.py"


rule tabulate_calibration:
    """Calibrated exponents and prefactors."""
    input:
        scaling="results/tables/scaling.csv",
        law="results/ensembles/law.nc",
    output:
        csv="results/tables/calibration.csv",
    log:
        "results/logs/tabulate_calibration.log",
    benchmark:
        "results/benchmarks/tabulate_calibration.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        **config["scaling"],
        conventions=SHOWN,
        seed=config["seed"],
        source=digest("tabulate_calibration"),
    message:
        "Calibrated exponents and prefactors"
    script:
        "../scripts/tabulate_calibration.py"


rule tabulate_sensitivities:
    """Exponents and prefactors in every convention."""
    input:
        discs="results/ensembles/discs.nc",
        variants="results/ensembles/variants.nc",
    output:
        csv="results/tables/sensitivities.csv",
    log:
        "results/logs/tabulate_sensitivities.log",
    benchmark:
        "results/benchmarks/tabulate_sensitivities.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        **config["scaling"],
        seed=config["seed"],
        source=digest("tabulate_sensitivities"),
    message:
        "Exponents and prefactors in every convention"
    script:
        "../scripts/tabulate_sensitivities.py"


rule plot_interface:
    """Figure: interface and punch in series."""
    input:
        interface="results/tables/interface.csv",
        interface_curves="results/tables/interface_curves.csv",
        literature="results/tables/literature.csv",
        periodic="results/tables/periodic.csv",
    output:
        figure=report(
            "results/figures/interface.{format}",
            caption="../report/figures/interface.rst",
            category="8 Beyond the paper",
            labels={"result": "interface and punch in series", "kind": "figure"},
        ),
    log:
        "results/logs/plot_interface/{format}.log",
    benchmark:
        "results/benchmarks/plot_interface/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_interface"),
    message:
        "Figure: interface and punch in series"
    script:
        "../scripts/plot_interface.py"


rule plot_reduction:
    """Figure: MDR, surface by surface."""
    input:
        reduction="results/tables/reduction.csv",
    output:
        figure=report(
            "results/figures/reduction.{format}",
            caption="../report/figures/reduction.rst",
            category="8 Beyond the paper",
            labels={"result": "MDR, surface by surface", "kind": "figure"},
        ),
    log:
        "results/logs/plot_reduction/{format}.log",
    benchmark:
        "results/benchmarks/plot_reduction/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_reduction"),
    message:
        "Figure: MDR, surface by surface"
    script:
        "../scripts/plot_reduction.py"


rule plot_media:
    """Figure: kinetics in other media."""
    input:
        media="results/tables/media.csv",
    output:
        figure=report(
            "results/figures/media.{format}",
            caption="../report/figures/media.rst",
            category="8 Beyond the paper",
            labels={"result": "kinetics in other media", "kind": "figure"},
        ),
    log:
        "results/logs/plot_media/{format}.log",
    benchmark:
        "results/benchmarks/plot_media/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_media"),
    message:
        "Figure: kinetics in other media"
    script:
        "../scripts/plot_media.py"


rule plot_histories:
    """Figure: any history."""
    input:
        histories="results/tables/histories.csv",
    output:
        figure=report(
            "results/figures/histories.{format}",
            caption="../report/figures/histories.rst",
            category="8 Beyond the paper",
            labels={"result": "any history", "kind": "figure"},
        ),
    log:
        "results/logs/plot_histories/{format}.log",
    benchmark:
        "results/benchmarks/plot_histories/{format}.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=digest("plot_histories"),
    message:
        "Figure: any history"
    script:
        "../scripts/plot_histories.py"


rule make_beyond_page:
    """The page of what goes beyond the paper."""
    input:
        literature="results/tables/literature.csv",
        figures=expand("results/figures/{figure}.png", figure=BEYOND_FIGURES),
    output:
        page="results/beyond.html",
    log:
        "results/logs/make_beyond_page.log",
    benchmark:
        "results/benchmarks/make_beyond_page.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        source=[digest("make_beyond_page"), *text_digests(PAGE_TEXTS)],
    message:
        "The page of what goes beyond the paper"
    script:
        "../scripts/make_beyond_page.py"


# ---- targets


rule beyond:
    """Periodic surfaces, the interface, other media and histories, the MDR disc by disc, and results/beyond.html."""
    input:
        "results/beyond.html",
        "results/tables/calibration.csv",


rule sensitivities:
    """The table of β and ζ for every convention that the paper leaves open; it needs further ensembles of discs."""
    input:
        "results/tables/sensitivities.csv",
