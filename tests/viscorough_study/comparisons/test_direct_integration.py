"""Direct integrations decide between the readings of the law."""

import numpy as np

from viscorough_study.comparisons.direct_integration import COLUMNS, compare_direct


def test_depths_are_elastic_ones_and_tend_to_the_exact_solution():
    """The grid's error falls with the elements in contact, and ends far below the tenth that the factor would make."""
    table = compare_direct(hursts=[0.4, 0.8], elements=33, impulses=25, seed=1)
    assert list(table) == list(COLUMNS)
    rough = table[table["case"].str.startswith("rough")]
    np.testing.assert_allclose(rough["depth_ratio"], 1, atol=1e-4)  # what the interpolation of a curve at 1e-6 leaves
    for body in ("sphere", "cone"):
        error = np.abs(table.loc[table["case"] == body, "depth_ratio"].to_numpy() - 1)
        assert error[-5:].max() < 0.01
        assert (table.loc[table["case"] == body, "with_gamma"] > 1.1).all()
