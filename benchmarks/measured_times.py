"""Which files of a run hold measured times, so that they differ from run to run."""

# Folders of results, and tables and figures under these names with any suffix.
FOLDERS = {"logs", "benchmarks", "methods", "large"}
NAMES = {
    "equal_error",
    "growth",
    "index",
    "large",
    "level_placement",
    "methods",
    "other_solvers",
    "rule_costs",
    "speed",
}


def holds_times(path):
    """Whether a file, by its path below the folder of results, holds measured times."""
    return path.parts[0] in FOLDERS or path.stem in NAMES
