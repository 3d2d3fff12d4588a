"""Labels of the conventions."""

from viscorough_study.conventions import VALUES
from viscorough_study.figures.labels import CONVENTION_LABELS


def test_every_convention_and_value_has_a_label():
    assert {name: set(labels) for name, labels in CONVENTION_LABELS.items()} == {
        name: set(values) for name, values in VALUES.items()
    }
