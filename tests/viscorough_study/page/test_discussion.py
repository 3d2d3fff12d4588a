"""Published results, as the page presents them."""

from support.figures import literature_table
from viscorough_study.page.discussion import KNOWN, discussion
from viscorough_study.page.results import Number, Results


def shown(**changes):
    table = literature_table().assign(place="here", when="before", statement="it is so", sure="abstract", read="there")
    return discussion(Results({"literature": table.assign(**changes)}, {}, {}))


def test_numbers_of_others_stand_beside_ours():
    rows = shown()["quantities"]["u0"]
    assert [row["hurst"] for row in rows] == [0.4, 0.9]
    assert rows[1]["value"] == Number(0.5, "literature", "value", 1)
    law, same = rows[1]["theirs"]
    assert law == ("One 2007", *(Number(value, "literature", f"theirs_{end}", 1) for end, value in ENDS.items()))
    assert same[0] == "One et al. 2013"
    assert same[1] == Number(0.4, "literature", "theirs_low", 3)


def test_every_source_is_listed_once_with_how_it_is_known():
    sources = shown()["sources"]
    assert [source["year"] for source in sources] == [2007, 2013, 2011]
    assert {source["known"] for source in sources} == {KNOWN["abstract"]}
    assert shown(sure="quoted")["quantities"]["u0"][0]["theirs"][0][0] == "One 2007, as quoted"
    assert shown(hurst=float("nan"))["quantities"] == {}


ENDS = {"low": 0.41, "high": 0.46}  # of the law at H = 0.9
