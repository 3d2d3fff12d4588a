"""Compare with published numbers of other groups, on free and periodic half-spaces.

    python benchmarks/outside.py --output results/outside.csv

The random surfaces of the sources are not known. The result of one surface of a source is compared with the mean of
ours. The tolerance is twice the standard deviation of ours; other tolerances have a stated reason. A row whose
deviation exceeds its tolerance stays in the table, with `met` = 0.
"""

import click
import numpy as np
import pandas as pd
from measuring import output_option, save_table
from scipy.signal import resample

from viscorough import Indenter, contact_at
from viscorough.results.contact_maps import EXCESS_PER_CHANGE
from viscorough.surfaces.self_affine import self_affine_square
from viscorough_study.comparisons.periodic_control import mean_separations, periodic_contact

# A free square, H = 0.8, waves 1 to 32 of the side, p/(E* h') = 0.30: raw and corrected contact fraction.
FREE_WAVES = 32
GRIDS, RAW, CORRECTED = (128, 256, 512), (0.4692, 0.4592, 0.4544), (0.4438, 0.4463, 0.4479)
STUDY = "ASPHER, convergence study"
SCATTER = "one surface of theirs: twice the standard deviation between ours"

# Periodic squares, power law of waves 8 to 64 of the period, at these p/(E* h').
PERIODIC_WAVES, ROLL_OFF = 64, {"roll_off_wavelength": 2 * 64 / 8, "roll_off_level": 1.0}
LIGHT, LEVELS = 0.01, np.geomspace(0.01, 0.16, 5)
AREA_SOURCE, SEPARATION_SOURCE = "Hyun and Robbins 2007; Monti et al. 2021", "Pastewka et al. 2013"
BETWEEN = "distance to the nearer of two theories, 1.60 (Persson) and 2.51 (Bush, Gibson and Thomas)"
ONE_DIGIT = "half of the last digit that is stated"


def surface(points, waves, seed, hurst, **roll_off):
    """Return heights of a periodic square of side and rms height 1, and their slope; waves : most along a side"""
    coarse = self_affine_square(hurst, 2 * waves, seed=seed, **roll_off)
    wave = np.fft.fftfreq(len(coarse), 1 / len(coarse))
    slope = np.linalg.norm(np.fft.fft2(coarse) * 2 * np.pi * np.hypot(wave[:, None], wave)) / coarse.size
    return resample(resample(coarse, points), points, axis=1), slope


def free_squares(surfaces):
    """Yield rows on the free square: its corrected area, the size of the correction, and changes over the grids."""
    areas = []
    for seed in range(surfaces):
        heights, slope = surface(GRIDS[-1], FREE_WAVES, seed, 0.8)
        for points in GRIDS:
            step = GRIDS[-1] // points
            contact = contact_at(Indenter(heights[::step, ::step], 1 / points), force=4 * 0.3 * slope, tolerance=1e-4)
            areas.append((contact.contact_area, contact.corrected_contact_area))
    theirs = area_quantities(RAW, CORRECTED)
    for name, values in area_quantities(*np.reshape(areas, (surfaces, len(GRIDS), 2)).T).items():
        yield "free", name, theirs[name], values.mean(), 2 * values.std(ddof=1), SCATTER, STUDY


def area_quantities(raw, corrected):
    """Return {quantity: value} of raw and corrected contact fractions on each of the grids."""
    corrections = {f"(A − A*)/A₀ on {n}²": raw[k] - corrected[k] for k, n in enumerate(GRIDS)}
    name = f"change of {{}}/A₀ from {GRIDS[0]}² to {GRIDS[-1]}²"
    changes = {name.format("A"): raw[-1] - raw[0], name.format("A*"): corrected[-1] - corrected[0]}
    return {f"A*/A₀ on {GRIDS[-1]}²": corrected[-1]} | corrections | changes


def periodic_squares(surfaces, points=512):
    """Yield rows on periodic squares: the coefficient of the area at a small pressure, and the plateau of u₀/h."""
    for hurst in (0.3, 0.8):
        coefficients, u0 = [], []
        for seed in range(surfaces):
            heights, slope = surface(points, PERIODIC_WAVES, seed, hurst, **ROLL_OFF)
            _, pressure = periodic_contact(heights, np.full(heights.shape, LIGHT * slope))
            contact = pressure > 0
            changes = sum(np.count_nonzero(contact != np.roll(contact, 1, axis)) for axis in (0, 1))
            coefficients.append((contact.sum() - EXCESS_PER_CHANGE * changes) / contact.size / LIGHT)
            u0.append(-np.diff(mean_separations(heights, LEVELS * slope)) / np.diff(np.log(LEVELS)))
        area, plateau = f"A* E* h′/(A₀ p), H = {hurst}", f"u₀/h, H = {hurst}"
        yield "periodic", area, 2.0, np.mean(coefficients), 0.4, BETWEEN, AREA_SOURCE
        yield "periodic", plateau, 0.4, np.mean(u0, axis=0).max(), 0.05, ONE_DIGIT, SEPARATION_SOURCE


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    names = ["half_space", "quantity", "published", "ours", "tolerance", "reason", "source"]
    table = pd.DataFrame([*free_squares(24), *periodic_squares(4)], columns=names)
    table.insert(4, "deviation", table["ours"] - table["published"])
    table.insert(6, "met", (table["deviation"].abs() <= table["tolerance"]).astype(int))
    click.echo(table.drop(columns=["reason", "source"]).to_string(index=False))
    save_table(table, output)


if __name__ == "__main__":
    main()
