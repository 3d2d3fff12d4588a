# The rule that makes the page of the results, which is the last output of `all`. It is made from results only.

# {file of a figure on the page: description for readers who cannot see the figure}. The report has their captions.
PAGE_FIGURES = {
    figure["file"]: figure["alternative"]
    for figure in REGISTRY.figures.values()
    if "alternative" in figure and (MEASURED or figure["target"] != "measured")
}
PAGE_TEXTS = sorted([*(WORKFLOW / "page").iterdir(), *(WORKFLOW / "report").rglob("*.rst"), WORKFLOW / "results.yaml"])
QUOTED = ("resources/published/other_solvers.csv", "docs/claims.csv", "docs/rules.png")
PAGE_TEXTS += [PROJECT / name for name in QUOTED]
PAGE_TABLES = [
    "claims",
    "scaling",
    "one_surface",
    "failure_map",
    "rule_costs",
    "media",
    "literature",
    "sufficient_models",
]
PAGE_TABLES += ["measured_scans", "measured_contacts", "measured_fits"] if MEASURED else []


rule make_page:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        tables=expand("results/tables/{table}.csv", table=PAGE_TABLES),
        figures=expand("results/figures/{file}.png", file=PAGE_FIGURES),
    output:
        page=report(
            "results/index.html",
            caption="../report/page.rst",
            category=chapter("summary"),
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
        text_digests(PAGE_TEXTS),
        claims=paper("claims"),
        numbers=paper("numbers"),
        alternative=PAGE_FIGURES,
    message:
        "The page of the results"
    script:
        "../scripts/make_page.py"
