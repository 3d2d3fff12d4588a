"""The benchmark of lines measures what it says."""


def test_lines_are_compared_with_a_transform(script):
    result = script("lines").measured(2000, 3)
    assert result["points"] == 2000
    ratio = result["ratio"]
    assert 0 < ratio["low"] <= ratio["median"] <= ratio["high"]
    assert result["line_wall_s"] > 0
    assert result["transform_wall_s"] > 0
    assert {"waves", "transform", "bins"} <= set(result)
