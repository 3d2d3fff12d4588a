"""Names of result files that hold measured times, and therefore differ from run to run."""

from pathlib import Path

import yaml

FOLDERS = {"logs", "benchmarks", "methods", "large"}
_RESULTS = yaml.safe_load((Path(__file__).parents[1] / "workflow/results.yaml").read_text(encoding="utf-8"))
_TABLES = {name for rule in _RESULTS["tables"].values() for name, table in rule["tables"].items() if table.get("timed")}
_FIGURES = {
    figure.get("file", name)
    for name, figure in _RESULTS["figures"].items()
    if _TABLES & {Path(path).stem for path in figure["input"].values()}
}
NAMES = _TABLES | _FIGURES | {"index"}  # names of tables and figures with any suffix, and of the page


def holds_times(path):
    """Return True if a file, by its path below the folder of results, holds measured times."""
    return path.parts[0] in FOLDERS or path.stem in NAMES
