"""Measure how well the two exact integrals of loading curves are met, by plain curves and by audits.

    python benchmarks/sum_rules.py --output results/sum_rules.json

The indenters are rough discs of 257 elements across, bodies, and discs with terraces, a hole and rectangular elements,
up to complete contact. Plain curves, as `indent` computes them, have tolerances from 1e-3 to 1e-8; audits have
tolerances of 1e-3 and 1e-5. The file has the relative deviations of all quadratures (viscorough.contact.sum_rules), and
the levels of the audits.
"""

from functools import partial

import click
import numpy as np
from measuring import output_option, save

from viscorough import Indenter, audit, complete_contact, indent, self_affine_disc
from viscorough.contact.sum_rules import integrals
from viscorough.reference import cone, sphere

ACROSS, SEED = 257, 1
ROUGH = self_affine_disc(0.6, ACROSS, seed=SEED).heights
HOLE = np.hypot(*np.indices(ROUGH.shape) - ACROSS // 3) < ACROSS / 8
INDENTERS = {
    **{f"H = {hurst:g}": partial(self_affine_disc, hurst, ACROSS, seed=SEED) for hurst in (0.1, 0.4, 0.6, 0.9)},
    "sphere": partial(sphere(1.0).indenter, 129),
    "cone": partial(cone(1.0).indenter, 129),
    "terraces": partial(Indenter, np.round(4 * ROUGH) / 4, 1 / ACROSS),
    "hole": partial(Indenter, np.where(HOLE, np.nan, ROUGH), 1 / ACROSS),
    "rectangles": partial(Indenter, ROUGH, 1 / ACROSS, 2 / ACROSS),
    "small, every event": partial(self_affine_disc, 0.1, 21, seed=SEED),
}
PLAIN, AUDITS = 10.0 ** -np.arange(3, 9), (1e-3, 1e-5)


def deviations(rules):
    """Return {integral: {quadrature: relative deviation}}."""
    return {name: getattr(rules, name).deviations for name in ("first", "second")}


def plain(indenter, complete, tolerance):
    """Return the deviations of a curve without added levels."""
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0, until_force=complete.force)
    return deviations(integrals(curve, complete))


def audited(indenter, tolerance):
    """Return the levels and deviations of an audited curve."""
    result = audit(indenter, tolerance=tolerance)
    return {"levels": result.curve.depth.size, **deviations(result.rules)}


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    results = {}
    for name, make in INDENTERS.items():
        indenter = make()
        complete = complete_contact(indenter)
        results[name] = {
            "plain": {f"{tolerance:.0e}": plain(indenter, complete, tolerance) for tolerance in PLAIN},
            "audit": {f"{tolerance:.0e}": audited(indenter, tolerance) for tolerance in AUDITS},
        }
        save({"across": ACROSS, "seed": SEED, "indenters": results}, output)


if __name__ == "__main__":
    main()
