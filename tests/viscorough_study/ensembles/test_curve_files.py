"""Files of curves: curves and labels are read exactly as written."""

from support.curves import assert_same_curve, random_curve
from viscorough_study.ensembles.curve_files import read_curves, write_curves
from viscorough_study.ensembles.realization import Realization


def test_curves_are_read_as_they_were_written(tmp_path):
    """Curves have different numbers of levels, and every label differs from curve to curve, or none does."""
    curves = [random_curve(5), random_curve(1, seed=1, method="dense"), random_curve(9, seed=2, elements=2)]
    for differ in (1, 0):
        written = []
        for number, curve in enumerate(curves):
            i = differ * number
            labels = (
                f"c{i}",
                number,
                0.3 + 0.1 * i,
                1 / (3 + i),
                0.1 + i,
                {"disc": 1.0 + number, "square": 1 / 3},
                3.0 + i,
            )
            written.append(({"name": labels[0]}, Realization(*labels), curve))
        write_curves(written, tmp_path / "curves.nc")
        read, settings = read_curves(tmp_path / "curves.nc")
        assert settings == [{"name": f"c{i}"} for i in range(1 + 2 * differ)]
        for (realization, curve), (_, same, as_written) in zip(read, written, strict=True):
            assert realization == same
            assert_same_curve(curve, as_written)
