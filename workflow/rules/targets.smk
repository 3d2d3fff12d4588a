# Targets besides `all` and single results.


rule curves:
    """The loading curves of all surfaces."""
    input:
        curves_of_pool("discs"),
        curves_of_pool("lines"),


for number, name in enumerate(("surfaces", "kinetics", "master_curve", "exponent"), 1):

    rule:
        name:
            f"figure_{number}"
        input:
            getattr(rules, f"plot_{name}").output,
        message:
            f"Figure {number} of the paper"


rule figures:
    """All figures."""
    input:
        [plot.output for plot in plots_of("all")],


rule tables:
    """All tables."""
    input:
        table_files("all"),


rule validation:
    """The comparison with exact solutions."""
    input:
        rules.check_validation.output,


rule measured:
    """Tables and figures of the measured surfaces that the settings name."""
    input:
        [plot.output for plot in plots_of("measured")] + table_files("measured") if MEASURED else [],


rule speed:
    """Speed against accuracy of every method, and the placement of levels."""
    input:
        rules.plot_speed.output,
        rules.plot_level_placement.output,


rule stability:
    """Failure map of all methods."""
    input:
        rules.plot_failure_map.output,


rule sizes:
    """Exponents on grids from coarse to fine."""
    input:
        rules.plot_sizes.output,
        rules.plot_collapse.output,


rule large:
    """Cost of one disc on grids from coarse to fine."""
    input:
        rules.plot_large.output,
        table_files("large"),
