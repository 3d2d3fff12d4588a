# The tables of workflow/results.yaml that functions make: one rule for each function, and one script.

# {name of an input: files}
TABLE_INPUTS = {
    "methods": expand("results/methods/{problem}.csv", problem=PROBLEMS),
    "costs_of_large": expand("results/large/{elements}.csv", elements=config["large"]["elements"]),
    "curves_of_combinations": curves_of_combinations(),
    "measured_curves": curves_of_pool("measured"),
}
FIT_OF_REGION = {name: value for name, value in config["scaling"].items() if name != "resamples"}
# {rule: further arguments of its function}
TABLE_PARAMS = {
    "fit_scaling": {"seed": config["seed"], **config["scaling"]},
    "tabulate_calibration": {"conventions": config["figures"], "across": config["discs"]["elements"]},
    "fit_interface": {"fit": interface_limits(), "rms_convention": config["figures"]["rms_convention"]},
    "compare_periodic": {
        **{name: value for name, value in config["periodic"].items() if name != "hurst"},
        "hursts": config["periodic"]["hurst"],
        "seed": config["seed"],
    },
    "validate": config["validation"],
    "match_lines": {
        "seed": config["seed"],
        "fit": config["scaling"],
        "conventions": {name: config["figures"][name] for name in ("rms_convention", "average")},
    },
    "compare_reduction": {
        **config["reduction"],
        "hursts": config["discs"]["hurst"],
        **{name: config["discs"][name] for name in ("elements", "realizations", "tolerance")},
        "seed": config["seed"],
    },
    "compare_direct": {**config["direct"], "hursts": config["discs"]["hurst"], "seed": config["seed"]},
    "measure_plateaus": plateau_settings(),
    "compare_zeta_laws": {
        "conventions": {name: config["figures"][name] for name in ("average", "rms_convention")},
        "hurst_mins": [0.0, number(paper("numbers"), "agreement", "beta_hurst_min")],
        "fit": FIT_OF_REGION,
        "resamples": config["scaling"]["resamples"],
        "seed": config["seed"],
    },
    "tabulate_literature": {
        "entries": read_yaml("resources/literature/stiffness.yaml"),
        "conventions": config["figures"],
    },
    "tabulate_methods": {
        name: value for name, value in config["methods"].items() if name not in ("tasks", "scenes", "pairs")
    }
    | {"seed": config["seed"]},
    "compare_level_placement": {
        **config["methods"]["scenes"],
        "seed": config["seed"],
        "repeats": config["methods"]["repeats"],
    },
    "time_other_solvers": {
        **{name: config["methods"][name] for name in ("pairs", "longest", "tasks")},
        "hursts": config["methods"]["hurst"],
        "seed": config["seed"],
        "peers": other_solvers(),
    },
    "map_failures": {
        **config["stability"],
        "seed": config["seed"],
        "hurst_min": number(paper("numbers"), "agreement", "beta_hurst_min"),
    },
    "fit_sizes": {
        "seed": config["seed"],
        "fit": config["scaling"],
        "windows": config["sizes"]["windows"],
        "tolerance": paper("claims")["beta"]["tolerance"],
        "conventions": config["figures"],
    },
    "compare_grids": {
        "elements_min": config["scaling"]["elements_min"],
        "rms_convention": config["figures"]["rms_convention"],
    },
    "fit_collapse": {
        "ranges": config["collapse"],
        "conventions": config["figures"],
        "fraction_min": config["scaling"]["fraction_min"],
        "tolerance": paper("claims")["beta"]["tolerance"],
        "seed": config["seed"],
    },
    "compute_media": {
        **config["media"],
        "rms_convention": config["figures"]["rms_convention"],
        "discs": cases.first_combination(config),
        "until_x": config["indentation"]["until_x"],
    },
    "evaluate_measured": {
        "names": list(MEASURED),
        "forces": [scan["forces"] for scan in MEASURED.values()],
        "media": config["media"]["cases"],
        "times": config["media"]["times"],
        "fit": config["scaling"],
        "seed": config["seed"],
    },
}

for name, made in TABULATIONS.items():

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
        localrule: not made["queued"]
        conda:
            "../envs/viscorough.yaml"
        threads: ALL_CORES if made["alone"] else 1
        resources:
            mem_mb=made["memory"],
        params:
            adapter_digests() if name == "time_other_solvers" else [],
            functions=table_functions(made),
            tables={
                table: {key: entry[key] for key in ("label", "dimension")} for table, entry in made["tables"].items()
            },
            timed=any(entry["timed"] for entry in made["tables"].values()),
            arguments=TABLE_PARAMS.get(name, {}),
        message:
            made["message"]
        script:
            "../scripts/tabulate.py"
