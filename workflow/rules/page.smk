# Rules that make the page of the results, which is the last output of `all`, and the article. Both are made from
# results only.

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


ARTICLE_FIGURES = ["fig1_surfaces", "fig2_kinetics", "fig3_master_curve", "fig4_exponent", "interface", "speed"]
ARTICLE_TABLES = ["validation", "interface", "periodic", "plateaus"]
ARTICLE_TEXTS = [*sorted((WORKFLOW / "article").iterdir()), PROJECT / "CITATION.cff"]
ARTICLE_TEXTS += [PROJECT / "resources/literature/stiffness.yaml"]
QUOTED = ("sum_rules.json", "outside.csv", "law.csv", "published.json")
ARTICLE_TEXTS += [PROJECT / "docs/results" / name for name in QUOTED]


rule article:
    """An article on the reproduction, results/article.pdf."""
    input:
        "results/article.pdf",


rule make_article:
    input:
        discs="results/ensembles/discs.nc",
        lines="results/ensembles/lines.nc",
        tables=expand("results/tables/{table}.csv", table=PAGE_TABLES + ARTICLE_TABLES),
        figures=expand("results/figures/{file}.pdf", file=ARTICLE_FIGURES),
    output:
        pdf="results/article.pdf",
    log:
        "results/logs/make_article.log",
    benchmark:
        "results/benchmarks/make_article.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=1000,
    params:
        text_digests(ARTICLE_TEXTS),
        claims=paper("claims"),
        numbers=paper("numbers"),
        repository=config["article"]["repository"],
    message:
        "The article"
    script:
        "../scripts/make_article.py"
