"""The benchmark of kinetics measures what it says."""


def test_both_media_are_timed(script):
    result = script("kinetics").measured(200, 50, 1)
    assert (result["prony"]["samples"], result["prony"]["branches"], result["springpot"]["samples"]) == (200, 10, 50)
    assert result["prony"]["wall_s"] > 0
    assert result["springpot"]["wall_s"] > 0
