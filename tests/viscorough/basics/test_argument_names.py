"""Names of arguments in messages, in Python and on the command line."""

from viscorough.basics.argument_names import argument, spelled_as_options


def test_a_value_is_named_if_there_is_one():
    assert [argument("until_force"), argument("detrend", "plane")] == ["until_force", "detrend='plane'"]
    with spelled_as_options():
        assert [argument("until_force"), argument("detrend", "plane")] == ["--until-force", "--detrend plane"]
