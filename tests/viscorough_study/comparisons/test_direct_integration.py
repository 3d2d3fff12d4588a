"""Direct integrations decide between the two readings of the law, with and without Γ."""

import numpy as np

from viscorough_study.comparisons.direct_integration import COLUMNS, compare_direct


def test_depths_follow_the_elastic_curve_and_the_exact_solution():
    """The error of the grid falls with the elements in contact and ends far below the 10 % that Γ would make."""
    table = compare_direct(hursts=[0.4, 0.8], elements=33, impulses=25, seed=1)
    assert list(table) == list(COLUMNS)
    rough = table[table["indenter"].str.startswith("rough")]
    np.testing.assert_allclose(rough["depth_ratio"], 1, atol=1e-4)  # error of the interpolation at a tolerance of 1e-6
    for body in ("sphere", "cone"):
        error = np.abs(table.loc[table["indenter"] == body, "depth_ratio"].to_numpy() - 1)
        assert error[-5:].max() < 0.01
        assert (table.loc[table["indenter"] == body, "with_gamma"] > 1.1).all()
