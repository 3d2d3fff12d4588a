# Targets for groups of results. Further targets are `all` and every single result.

# {target: (its description, the files that it makes)}
TARGETS = {
    "curves": (
        "The loading curves of all surfaces.",
        [*cases.pool_curves(CASES, "discs"), *cases.pool_curves(CASES, "lines")],
    ),
    "figures": ("All figures.", figure_files("all")),
    "tables": ("All tables.", table_files("all")),
    "validation": ("The comparison with exact solutions.", rules.check_validation.output),
    "measured": (
        "Tables and figures of the measured surfaces that the settings name.",
        figure_files("measured") + table_files("measured") if MEASURED else [],
    ),
    "speed": (
        "Speed against accuracy of every model and method, and the placement of levels.",
        [rules.plot_speed.output, rules.plot_level_placement.output],
    ),
    "stability": (
        "Where methods fail, and the failure map.",
        [rules.plot_failures.output, rules.plot_failure_map.output],
    ),
    "sizes": ("Exponents on grids from coarse to fine.", [rules.plot_sizes.output, rules.plot_collapse.output]),
}
TARGETS |= {
    f"figure_{number}": (f"Figure {number} of the paper", getattr(rules, f"plot_{name}").output)
    for number, name in enumerate(("surfaces", "kinetics", "master_curve", "exponent"), 1)
}

for target, (description, files) in TARGETS.items():

    rule:
        name:
            target
        input:
            files,
        message:
            description
