"""Measure the cost of a member of an ensemble, and the effect of its tolerance on the mean.

    python benchmarks/members.py --output results/members.json

Discs of the first combination of every Hurst exponent are indented as in the workflow, from their seeds to κ at the
abscissae of the ensemble, with `discs.tolerance` and `discs.whole_curves` of the settings. They alternate with whole
curves by `viscorough.indent` of the same discs at its default tolerance. `--repeats` is the number of discs. Keys, for
each Hurst exponent: `member_s` and `curve_s`, the means of the processor time of both, and `ratio`, their quotient; the
root mean squares over X, up to `discs.short_until_x`, of `mean_error`, the change of the mean of ln(vt/h) over these
discs by the tolerance, of `disc_error`, the same for a single disc, of its `scatter` over the discs, and of
`standard_error`, that of the mean over as many discs as the settings have for a Hurst exponent; and `beta_error`, the
change of the mean's slope over `WINDOW`.
"""

from pathlib import Path

import numpy as np
import yaml
from measuring import command

from viscorough_study.ensembles.averages import abscissa, on_abscissae
from viscorough_study.ensembles.discs import ensemble_disc
from viscorough_study.ensembles.indentation import end_of_curve, indent_surface
from viscorough_study.fits.power_law import in_window
from viscorough_study.performance import timing
from viscorough_study.run import cases
from viscorough_study.run.seeds import realization_seed

ROOT = Path(__file__).resolve().parents[1]
TOLERANCE = 1e-3  # default of viscorough.indent
WINDOW = 1e-3, 1e-1  # X of region (b)


def measured(discs, settings=None):
    """Content of the file, from `discs` discs of each Hurst exponent."""
    settings = settings or yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    ensembles, ensemble = cases.combined_ensembles(settings), settings["ensemble"]
    x = abscissa(ensemble["x_low"], settings["discs"]["short_until_x"], ensemble["per_decade"])
    content = {"tolerance": settings["discs"]["tolerance"], "hurst": {}}
    for name in cases.first_combination(settings):
        ensemble = ensembles[name]
        _turn(settings, ensemble, 0, 0, x)  # loads the compiled code
        # The fraction of whole curves is that of the ensemble.
        kept = round(discs * settings["discs"]["whole_curves"] / settings["discs"]["realizations"])
        turns = [_turn(settings, ensemble, number, kept, x) for number in range(discs)]
        content["hurst"][f"{ensemble['surface']['hurst']:g}"] = _summary(settings, turns, x)
    return content


def _turn(settings, ensemble, number, whole_curves, x):
    """Processor seconds of a member and of a whole curve, and ln(vt/h) of both over X."""
    discs, indentation, surface = settings["discs"], settings["indentation"], ensemble["surface"]
    ends = {"until_x": indentation["until_x"], "short_until_x": discs["short_until_x"], "whole_curves": whole_curves}
    until_fraction = indentation["until_fraction"]

    def member():
        seed = realization_seed(settings["seed"], *ensemble["spawn_key"], number)
        disc, rms = ensemble_disc(ensemble["elements"], surface, seed)
        until = {"until_x": end_of_curve(number, ends), "until_fraction": until_fraction}
        curve = indent_surface(disc, rms, surface["diameter"], tolerance=discs["tolerance"], **until)
        conventions = {name: rms[name] for name in cases.POOLS["discs"]}
        return disc, rms, on_abscissae([curve], conventions, surface["diameter"], x)[0][0, 0]

    def whole_curve():
        until = {"until_x": indentation["until_x"], "until_fraction": until_fraction}
        return indent_surface(disc, rms, surface["diameter"], tolerance=TOLERANCE, **until)

    (disc, rms, member_stiffness), _, member_s = timing.timed(member)
    whole, _, curve_s = timing.timed(whole_curve)
    whole_stiffness = on_abscissae([whole], {"disc": rms["disc"]}, surface["diameter"], x)[0][0, 0]
    return member_s, curve_s, np.log(x / member_stiffness), np.log(x / whole_stiffness)


def _summary(settings, turns, x):
    """Columns of one Hurst exponent."""
    member, curve = np.mean([turn[:2] for turn in turns], axis=0)
    members, wholes = (np.array([turn[i] for turn in turns]) for i in (2, 3))
    errors, scatter = members - wholes, wholes.std(axis=0, ddof=1)
    number = len(settings["discs"]["combinations"]) * settings["discs"]["realizations"]
    inside, mean = in_window(x, WINDOW), errors.mean(axis=0)
    quantities = {"mean_error": mean, "disc_error": errors, "scatter": scatter}
    quantities["standard_error"] = scatter / np.sqrt(number)
    columns = {"member_s": member, "curve_s": curve, "ratio": member / curve}
    columns |= {name: np.sqrt(np.mean(values**2)) for name, values in quantities.items()}
    return columns | {"beta_error": np.polyfit(np.log(x[inside]), mean[inside], 1)[0]}


main = command(measured, repeats=40)

if __name__ == "__main__":
    main()
