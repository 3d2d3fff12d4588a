"""Measure what a member of an ensemble costs, and what its tolerance does to the mean.

    python benchmarks/members.py --output results/members.json

Discs of the first combination of every Hurst exponent are indented as the workflow does, from their seeds to κ at the
abscissae of the ensemble, with `discs.tolerance` and `discs.whole_curves` of the settings. They take turns with whole
curves by `viscorough.indent` of the same discs at its default tolerance. Keys, for each Hurst exponent: `member_s` and
`curve_s`, the means of the processor time of both, `ratio` their quotient; the root mean squares over X, up to
`discs.short_until_x`, of `mean_error`, the change of the mean of ln(vt/h) over these discs by the tolerance, of
`disc_error`, the same of a single disc, of its `scatter` over the discs, and of `standard_error`, that of the mean over
as many discs as the settings have for a Hurst exponent; and `beta_error`, the change of the mean's slope over `WINDOW`.
"""

import os
import sys
import time
from pathlib import Path

import click
import numpy as np
import yaml

import viscorough
from viscorough_study import cases
from viscorough_study.discs import end_of_curve, ensemble_disc, indent_disc
from viscorough_study.ensembles import abscissa, on_abscissae
from viscorough_study.performance import timing
from viscorough_study.power_law import in_window
from viscorough_study.seeds import realization_seed
from viscorough_study.tables import write_json

ROOT = Path(__file__).resolve().parents[1]
TOLERANCE = 1e-3  # default of viscorough.indent
ONE_THREAD = "NUMBA_NUM_THREADS", "OMP_NUM_THREADS"
WINDOW = 1e-3, 1e-1  # X of region (b)


def measured(settings, discs):
    """The content of the file, from so many discs of each Hurst exponent."""
    ensembles, ensemble = cases.combined_ensembles(settings), settings["ensemble"]
    x = abscissa(ensemble["x_low"], settings["discs"]["short_until_x"], ensemble["per_decade"])
    content = {"machine": timing.machine(), "viscorough": viscorough.__version__, "discs": discs}
    content |= {"tolerance": settings["discs"]["tolerance"], "hurst": {}}
    for name in cases.first_combination(settings):
        one = ensembles[name]
        _turn(settings, one, 0, 0, x)  # loads the compiled code
        # The shares of whole curves among those measured and of the ensemble are the same.
        kept = round(discs * settings["discs"]["whole_curves"] / settings["discs"]["realizations"])
        turns = [_turn(settings, one, number, kept, x) for number in range(discs)]
        content["hurst"][f"{one['surface']['hurst']:g}"] = _summary(settings, turns, x)
    return content


def _turn(settings, ensemble, number, whole_curves, x):
    """Processor seconds of a member and of a whole curve, and ln(vt/h) of both over X."""
    discs, indentation, surface = settings["discs"], settings["indentation"], ensemble["surface"]
    until_fraction = {"until_fraction": indentation["until_fraction"]}
    ends = {"until_x": indentation["until_x"], "short_until_x": discs["short_until_x"], "whole_curves": whole_curves}
    start = time.process_time()
    seed = realization_seed(settings["seed"], *ensemble["spawn_key"], number)
    disc, rms = ensemble_disc(ensemble["elements"], surface, seed)
    until_x = end_of_curve(number, ends)
    member = indent_disc(
        disc, rms, surface["diameter"], tolerance=discs["tolerance"], until_x=until_x, **until_fraction
    )
    conventions = {name: rms[name] for name in cases.POOLS["discs"]}
    of_member = on_abscissae([member], conventions, surface["diameter"], x)[0][0, 0]
    middle = time.process_time()
    whole = indent_disc(
        disc, rms, surface["diameter"], tolerance=TOLERANCE, until_x=indentation["until_x"], **until_fraction
    )
    end = time.process_time()
    of_whole = on_abscissae([whole], {"disc": rms["disc"]}, surface["diameter"], x)[0][0, 0]
    return middle - start, end - middle, np.log(x / of_member), np.log(x / of_whole)


def _summary(settings, turns, x):
    """Columns of one Hurst exponent."""
    member, curve = np.mean([turn[:2] for turn in turns], axis=0)
    members, wholes = (np.array([turn[i] for turn in turns]) for i in (2, 3))
    errors, scatter = members - wholes, wholes.std(axis=0, ddof=1)
    number = len(settings["discs"]["combinations"]) * settings["discs"]["realizations"]
    inside, mean = in_window(x, WINDOW), errors.mean(axis=0)
    quantities = {
        "mean_error": mean,
        "disc_error": errors,
        "scatter": scatter,
        "standard_error": scatter / np.sqrt(number),
    }
    columns = {"member_s": member, "curve_s": curve, "ratio": member / curve}
    columns |= {name: np.sqrt(np.mean(values**2)) for name, values in quantities.items()}
    return columns | {"beta_error": np.polyfit(np.log(x[inside]), mean[inside], 1)[0]}


@click.command(help=__doc__.splitlines()[0])
@click.option("--discs", type=click.IntRange(2), default=40, show_default=True, help="Of each Hurst exponent.")
@click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")
def main(discs, output):
    if any(os.environ.get(name) != "1" for name in ONE_THREAD):  # as in the workflow; libraries read it at their start
        os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
        os.execv(sys.executable, [sys.executable, *sys.argv])
    settings = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    content = measured(settings, discs)
    output.parent.mkdir(parents=True, exist_ok=True)
    write_json(content, output)
    for hurst, values in content["hurst"].items():
        text = "{ratio:.2f} of the time of a curve, mean off by {mean_error:.1e} beside {standard_error:.1e}"
        click.echo(f"H = {hurst}: {text.format(**values)}, slope off by {values['beta_error']:.1e}")
    click.echo(f"written to {output}")


if __name__ == "__main__":
    main()
