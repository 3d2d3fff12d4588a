# Rules that draw Figures 1 to 4 of the paper and all other figures of workflow/results.yaml: as PNG for the report, and
# as PDF for vector graphics.

# {further argument of the functions that draw figures: its value}
FIGURE_PARAMS = {
    "combinations": {name: ensemble["combination"] for name, ensemble in cases.combined_ensembles(config).items()},
    "conventions": config["figures"],
    "fraction_min": config["scaling"]["fraction_min"],
    "hurst_range": paper("laws")["beta"]["hurst_range"],
    "other_solvers": read_records(PROJECT / "resources/published/other_solvers.csv"),
}

for name, figure in REGISTRY.figures.items():

    rule:
        name:
            f"plot_{name}"
        input:
            **{argument: f"results/{path}" for argument, path in figure["input"].items()},
        output:
            png=report(
                f"results/figures/{figure['file']}.png",
                caption=f"../report/figures/{figure['file']}.rst",
                category=chapter(figure["chapter"]),
                labels={"result": figure["label"], "kind": "figure"},
            ),
            pdf=f"results/figures/{figure['file']}.pdf",
        log:
            f"results/logs/plot_{name}.log",
        benchmark:
            f"results/benchmarks/plot_{name}.tsv"
        localrule: True
        conda:
            "../envs/viscorough.yaml"
        resources:
            mem_mb=1000,
        params:
            **{param: FIGURE_PARAMS[param] for param in figure["params"]},
            functions=REGISTRY.figure_functions(name),
        message:
            f"Figure: {figure['label']}"
        script:
            "../scripts/plot.py"
