# Rules for the tables of workflow/results.yaml that fits.smk and verdicts.smk do not make. There is a rule for each
# function that makes tables, and one script for all these rules.

# {name of an input in workflow/results.yaml that consists of several files: these files}
TABLE_INPUTS = {
    "curves_of_combinations": cases.combination_curves(DISCS),
    "measured_curves": cases.pool_curves(CASES, "measured"),
}
SEED = {"seed": config["seed"]}
BETA_HURST_MIN = paper("numbers")["agreement"]["beta_hurst_min"]["value"]
CONTROLS = (case["name"] for case in config["variants"]["cases"] if case.get("roll_off_wavelength"))
# Settings that determine the contacts of a measured surface. The digest changes with the content of its file.
PRESSED = ("group", "file", "digest", "spacing", "unit", "preparation", "forces", "young_modulus", "poisson_ratio")
# {rule: further arguments of the function that makes its tables}
TABLE_PARAMS = {
    "tabulate_calibration": {"conventions": config["figures"], "across": config["discs"]["elements"]},
    "compare_periodic": without("periodic", "hurst") | {"hursts": config["periodic"]["hurst"]} | SEED,
    "validate": config["validation"],
    "compare_reduction": config["reduction"]
    | chosen("discs", "elements", "realizations", "tolerance")
    | {"hursts": config["discs"]["hurst"]}
    | SEED,
    "compare_direct": config["direct"] | {"hursts": config["discs"]["hurst"]} | SEED,
    "compare_histories": chosen("direct", "elements") | {"hursts": config["discs"]["hurst"]} | SEED,
    "measure_plateaus": {
        "control": next(CONTROLS, None),
        "region": without("scaling", "stiffness_range", "resamples"),
        "x_range": config["verdicts"]["plateau_range"],
        "half_width": config["scaling"]["slope_half_width"],
        "tolerance": paper("claims")["power_law"]["tolerance"],
        **chosen("verdicts", "decades_min", "draws"),
        **chosen("figures", "rms_convention"),
        **chosen("scaling", "resamples"),
        **SEED,
    },
    "compare_zeta_laws": {
        "conventions": chosen("figures", "average", "rms_convention"),
        "hurst_mins": [0.0, BETA_HURST_MIN],
        "fit": without("scaling", "resamples"),
        **chosen("scaling", "resamples"),
        **SEED,
    },
    "tabulate_literature": {
        "entries": read_yaml("resources/literature/stiffness.yaml"),
        "conventions": config["figures"],
    },
    "measure_methods": {
        "problems": cases.method_problems(config),
        **chosen("methods", "levels", "repeats", "longest"),
        **SEED,
    },
    "measure_surfaces": config["methods"]["one_surface"] | SEED,
    "compare_means": {"conventions": config["figures"]},
    "compare_level_placement": config["methods"]["scenes"] | chosen("methods", "repeats") | SEED,
    "map_failures": config["stability"] | {"hurst_min": BETA_HURST_MIN} | SEED,
    "vary_settings": {"conventions": config["figures"], **chosen("stability", "across")} | SEED,
    "fit_sizes": config["scaling"] | chosen("sizes", "windows") | SEED,
    "compare_grids": chosen("scaling", "elements_min") | chosen("figures", "rms_convention"),
    "fit_collapse": {
        "ranges": config["collapse"],
        "conventions": config["figures"],
        "tolerance": paper("claims")["beta"]["tolerance"],
        **chosen("scaling", "fraction_min"),
        **SEED,
    },
    "compute_media": {
        **config["media"],
        **chosen("figures", "rms_convention"),
        "discs": cases.first_combination(config),
    },
    "press_measured": {
        "scans": [{"name": name} | {key: scan[key] for key in PRESSED} for name, scan in MEASURED.items()],
    },
    "evaluate_measured": {
        "names": list(MEASURED),
        "forces": [scan["forces"] for scan in MEASURED.values()],
        "media": config["media"]["cases"],
        "fit": config["scaling"],
        **chosen("media", "times"),
        **SEED,
    },
}

for name, made in REGISTRY.table_rules.items():
    if "function" not in made:
        continue

    rule:
        name:
            name
        input:
            **{argument: TABLE_INPUTS.get(path, f"results/{path}") for argument, path in made["input"].items()},
        output:
            csv=expand("results/tables/{table}.csv", table=made["tables"]),
            nc=expand("results/tables/{table}.nc", table=made["tables"]),
        log:
            f"results/logs/{name}.log",
        benchmark:
            f"results/benchmarks/{name}.tsv"
        # jobs that run alone come first: at the end, the jobs that use their tables would have to wait for them
        priority: 3 if made["alone"] else 0
        localrule: not made["queued"]
        conda:
            "../envs/viscorough.yaml"
        threads: ALL_CORES if made["alone"] else 1
        resources:
            mem_mb=made["memory"],
        params:
            functions=REGISTRY.table_functions(name),
            tables=made["tables"],
            arguments=TABLE_PARAMS.get(name, {}),
        message:
            made["message"]
        script:
            "../scripts/tabulate.py"
