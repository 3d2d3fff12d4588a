"""Names of result files that hold measured times, and therefore differ from run to run."""

FOLDERS = {"logs", "benchmarks"}
# Names of tables and figures with any suffix, and of the page.
NAMES = {"methods", "one_surface", "mean_accuracy", "sufficient_models", "level_placement", "rule_costs"}
NAMES |= {"large", "speed", "index"}


def holds_times(path):
    """Return True if a file, by its path below the folder of results, holds measured times."""
    return path.parts[0] in FOLDERS or path.stem in NAMES
