"""Contacts in NetCDF files: the precision of their maps."""

import dataclasses

import numpy as np
import pytest

import viscorough
from viscorough import contact_at, self_affine_disc
from viscorough.io.contact_files import contacts_to_content
from viscorough.io.datasets import read_dataset

DISC = self_affine_disc(0.7, 17, rms=0.01, seed=1)
CONTACT = contact_at(DISC, depth=0.005)


@pytest.mark.parametrize(("tolerance", "precision"), [(1e-2, "f4"), (1e-4, "f4"), (0.99e-4, "f8"), (1e-8, "f8")])
def test_maps_have_the_precision_of_the_contact(tmp_path, tolerance, precision):
    """Maps are in single precision for tolerances of 1e-4 or more; single numbers are always in double precision."""
    contact = dataclasses.replace(CONTACT, tolerance=tolerance)
    viscorough.save(contact, tmp_path / "contact.nc")
    variables = read_dataset(tmp_path / "contact.nc").variables
    for name in ("pressure", "gap"):
        np.testing.assert_array_equal(variables[name].values, getattr(contact, name).astype(precision), strict=True)
    for name in ("depth", "force", "stiffness", "largest_pressure"):
        np.testing.assert_array_equal(variables[name].values, np.float64(getattr(contact, name)), strict=True)
    np.testing.assert_array_equal(variables["contact"].values, contact.contact.astype(np.int8), strict=True)


@pytest.mark.parametrize(
    "change",
    [{"depth": 1e-26}, {"force": 1e-27}, {"pressure": 1e31 * CONTACT.pressure}, {"gap": 1e31 + CONTACT.gap}],
    ids=lambda change: next(iter(change)),
)
def test_maps_beyond_single_precision_are_stored_in_double(change):
    assert contacts_to_content([CONTACT])[0]["gap"][1].dtype == np.float32
    outside = dataclasses.replace(CONTACT, **change)
    for contacts in ([outside], [CONTACT, outside]):
        variables = contacts_to_content(contacts)[0]
        assert variables["pressure"][1].dtype == variables["gap"][1].dtype == np.float64
