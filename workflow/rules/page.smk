# The page of the results: the last thing that `all` makes, from results only.

# Figures on the page, each with the caption of the same name that it has in the report.
PAGE_FIGURES = {
    "fig1_surfaces": rules.plot_surfaces,
    "fig2_kinetics": rules.plot_kinetics,
    "fig3_master_curve": rules.plot_master_curve,
    "fig4_exponent": rules.plot_exponent,
    "speed": rules.plot_speed,
    "failure_map": rules.plot_failure_map,
    "level_placement": rules.plot_level_placement,
    "conventions": rules.plot_conventions,
    "prefactors": rules.plot_prefactors,
    "interface": rules.plot_interface,
    "direct": rules.plot_direct,
    "reduction": rules.plot_reduction,
    "mdr_lambda": rules.plot_mdr_lambda,
    "validation": rules.plot_validation,
    "media": rules.plot_media,
    "media_exponents": rules.plot_media_exponents,
    "sizes": rules.plot_sizes,
    "collapse": rules.plot_collapse,
} | ({"measured": rules.plot_measured} if MEASURED else {})


rule make_page:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        other_solvers=[rules.time_other_solvers.output.csv] if other_solvers_wanted() else [],
        tables=[
            rules.judge_claims.output.csv,
            rules.fit_scaling.output.csv,
            rules.tabulate_methods.output.csv,
            rules.map_failures.output.csv,
            rules.compare_level_placement.output.csv,
            rules.tabulate_rule_costs.output.csv,
            rules.compute_media.output.csv,
            rules.tabulate_literature.output.csv,
        ]
        + ([rules.evaluate_measured.output[name][0] for name in ("scans", "fits")] if MEASURED else []),
        figures=[rule.output.png for rule in PAGE_FIGURES.values()],
    output:
        page=report(
            "results/index.html",
            caption="../report/page.rst",
            category=chapter("summary"),
            labels={"result": "what was found", "kind": "page"},
        ),
    log:
        "results/logs/make_page.log",
    benchmark:
        "results/benchmarks/make_page.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    threads: 1
    resources:
        mem_mb=1000,
    params:
        page_digests(),
        claims=paper("claims"),
        numbers=paper("numbers"),
    message:
        "The page of the results"
    script:
        "../scripts/make_page.py"
