"""Label the surfaces of an ensemble, and state their lengths."""

from typing import NamedTuple

RMS = {
    "disc": "rms height over the disc",
    "square": "rms height over the periodic square",
    "ensemble": "rms height over the periodic square on average over all realizations of its spectrum",
    "line": "rms height of the line",
}


class Realization(NamedTuple):
    """Labels, Hurst exponent and lengths of one surface of an ensemble.

    All lengths are in the unit of length of the indenter, which is "m", or "1" if lengths are dimensionless.

    ensemble : name of the ensemble
    number : number of the realization in the ensemble
    hurst : Hurst exponent, nan for a measured surface
    diameter : L, the diameter of a disc, or the length of a line
    spacing : distance between neighbouring columns of a map of heights, or between neighbouring points of a line
    rms : {key of `RMS`, which says where the rms height is measured: rms height}
    until_x : X = F/(4GhL) that the loading curve is to reach; nan for a surface whose curve was not computed
    """

    ensemble: str
    number: int
    hurst: float
    diameter: float
    spacing: float
    rms: dict
    until_x: float = float("nan")

    @property
    def until_force(self):
        """Return F/G at X = `until_x`.

        h is the rms height over the disc or line. If a disc is cut from a square, h is the larger of the rms heights
        over the disc and over the square.
        """
        rms = max(self.rms[name] for name in ("disc", "square", "line") if name in self.rms)
        return 4 * rms * self.diameter * self.until_x


def stored_settings(ensemble, **further):
    """Return the settings of an ensemble as files state them, independent of the division into batches.

    ensemble : description of the ensemble (run.samples.batch_ensembles), whose entry `numbers` is left out
    further : further settings
    """
    return further | {name: value for name, value in ensemble.items() if name != "numbers"}
