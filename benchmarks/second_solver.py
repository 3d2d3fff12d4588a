"""Compute loading curves of the study's discs by a second solver, and compare curves, β and ζ.

    python benchmarks/second_solver.py --output results/tables/second_solver.csv

ContactMechanics (peers/) shares no code with this package. For each Hurst exponent, both solvers solve discs of
reading A at the same depths, which reach the abscissae X = F/(4GhL) of this package's curve. The discs are made as
those of the default run, with other seeds. Stiffnesses are difference quotients k = ΔF/Δu of neighbouring depths, the
same for both solvers. β and ζ of vt/h = X^β/ζ follow from a straight line through ln(vt/h) = ln(X/κ), κ = k/(4GL), over
ln X at all quotients of all discs. The table has the columns of COLUMNS. `make speed` runs the script;
without the environment of `make peers` it writes nothing.
"""

import click
import numpy as np
import other_solvers
import pandas as pd
from measuring import output_option, run_timed, save_times

from viscorough import indent, self_affine_disc
from viscorough_study.run.seeds import disc_key, realization_seed

SOLVER, HURST, DISCS, ELEMENTS, SEED = "ContactMechanics", (0.1, 0.4, 0.6, 0.9), 20, 257, 2013
X = np.geomspace(5e-3, 0.3, 9)  # in region (b)
TOLERANCE = 1e-6  # of both solvers, over the depth
LONGEST = 300.0  # seconds after which a disc is abandoned
COLUMNS = {
    "hurst": ("Hurst exponent of the discs", "1"),
    "discs": ("discs", "1"),
    "elements": ("elements across the discs", "1"),
    "levels": ("depths of each disc", "1"),
    "solver": ("the other solver", ""),
    "version": ("its version", ""),
    "residual": ("largest |gap| in contact or overlap outside it of the other solver, over the depth", "1"),
    "force_difference": ("largest relative difference of the forces at any depth of any disc", "1"),
    "beta": ("exponent β by this package, from difference quotients", "1"),
    "beta_difference": ("β of the other solver less this β", "1"),
    "zeta": ("prefactor ζ by this package, from difference quotients", "1"),
    "zeta_difference": ("ζ of the other solver over this ζ, less 1", "1"),
    "processor_s": ("processor time of the other solver, all discs", "s"),
}


def power_law(depths, forces):
    """Return β and ζ of discs with h = L = 1; depths, forces : u and F/G, shape (discs, levels)"""
    x = np.sqrt(forces[:, 1:] * forces[:, :-1]) / 4
    velocity = x / (np.diff(forces) / np.diff(depths) / 4)
    beta, intercept = np.polyfit(np.log(x).ravel(), np.log(velocity).ravel(), 1)
    return beta, np.exp(-intercept)


def compared(hurst, solver):
    """Return a row of the table: the differences between the solvers at one Hurst exponent.

    solver : name and command, an item of other_solvers.installed
    """
    depths, forces, answers = [], [], []
    for number in range(DISCS):
        disc = self_affine_disc(hurst, ELEMENTS, seed=realization_seed(SEED, *disc_key(hurst, 0), number))
        first = indent(disc, tolerance=1e-3, until_force=4 * X[-1] * 1.001)
        levels = first.at_force(4 * X)[0]
        own = indent(disc, tolerance=TOLERANCE, depths=levels)
        answer = other_solvers.solve(solver, disc, levels, own.force, TOLERANCE, time_limit=LONGEST)
        if answer is None:
            raise click.ClickException(f"{SOLVER} has no solution for H = {hurst:g}, disc {number}")
        depths.append(levels)
        forces.append(own.force)
        answers.append(answer)
    depths, forces, others = np.array(depths), np.array(forces), np.array([answer.force for answer in answers])
    (beta, zeta), (beta_other, zeta_other) = power_law(depths, forces), power_law(depths, others)
    return {
        "hurst": hurst,
        "discs": DISCS,
        "elements": ELEMENTS,
        "levels": X.size,
        "solver": SOLVER,
        "version": answers[0].version,
        "residual": max(answer.residual.max() for answer in answers),
        "force_difference": np.abs(others / forces - 1).max(),
        "beta": beta,
        "beta_difference": beta_other - beta,
        "zeta": zeta,
        "zeta_difference": zeta_other / zeta - 1,
        "processor_s": sum(answer.processor_s for answer in answers),
    }


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    for solver in other_solvers.installed([SOLVER]).items():
        table = pd.DataFrame([compared(hurst, solver) for hurst in HURST])
        settings = {
            "hurst": HURST,
            "discs": DISCS,
            "elements": ELEMENTS,
            "x": X.tolist(),
            "tolerance": TOLERANCE,
            "seed": SEED,
        }
        save_times(table, output, COLUMNS, "Loading curves by a second solver", settings)


if __name__ == "__main__":
    run_timed(main)
