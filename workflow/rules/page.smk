# The page of the results, which is the last output of `all`. It uses results only.


# Figures of the page; workflow/page/figures.yaml describes them for readers who cannot see them.
PAGE_FIGURES = [
    "fig1_surfaces",
    "fig2_kinetics",
    "fig3_master_curve",
    "fig4_exponent",
    "regions",
    "direct",
    "mdr_lambda",
    "validation",
    "speed",
    "failures",
]
# Tables whose numbers the page states.
PAGE_TABLES = ["claims", "scaling", "methods", "one_surface", "failures", "sufficient_models"]
if MEASURED:
    PAGE_FIGURES.append("measured")
    PAGE_TABLES += ["measured_scans", "measured_contacts", "measured_fits"]
BEYOND_FIGURES = ["interface", "reduction", "media", "histories"]
# {figure in docs/results that the page shows without drawing it: command that draws it}
PUBLISHED_FIGURES = {"local_exponent": "make fine-grids"} | dict.fromkeys(BEYOND_FIGURES, "make beyond")
# Further files that the page shows or quotes.
PAGE_TEXTS = [
    *sorted(path for path in (WORKFLOW / "page").rglob("*") if path.is_file()),
    *sorted((WORKFLOW / "report").rglob("*.rst")),
    PROJECT / "resources/published/fine_exponents.csv",
    PROJECT / "resources/published/other_solvers.csv",
    PROJECT / "resources/published/second_solver.csv",
    PROJECT / "resources/published/default_run.yaml",
    *(PROJECT / f"docs/results/{figure}.png" for figure in PUBLISHED_FIGURES),
    PROJECT / "docs/rules.png",
]


rule make_page:
    """The page of the results."""
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        tables=expand("results/tables/{table}.csv", table=PAGE_TABLES),
        figures=expand("results/figures/{figure}.png", figure=PAGE_FIGURES),
    output:
        page=report(
            "results/index.html",
            caption="../report/page.rst",
            category="1 Summary",
            labels={"result": "questions and answers", "kind": "page"},
        ),
    log:
        "results/logs/make_page.log",
    benchmark:
        "results/benchmarks/make_page.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        numbers=NUMBERS,
        combinations=samples.combinations(config),
        fraction_min=config["scaling"]["fraction_min"],
        published=PUBLISHED_FIGURES,
        changed=changed_settings(check_settings(read_yaml("config/config.yaml")), config),
        files=[path_shown(path) for path in SETTINGS_FILES],
        source=[digest("make_page"), *text_digests(PAGE_TEXTS)],
    message:
        "The page of the results"
    script:
        "../scripts/make_page.py"


# ---- targets


rule figures:
    """The figures of the page."""
    input:
        expand("results/figures/{figure}.png", figure=PAGE_FIGURES),


rule measured:
    """Tables and figures of the measured surfaces that the settings name."""
    input:
        [
            "results/tables/measured_contacts.csv",
            "results/tables/measured_scans.csv",
            "results/tables/measured_fits.csv",
            "results/tables/measured_kinetics.csv",
            "results/figures/measured.png",
        ]
        if MEASURED
        else [],
