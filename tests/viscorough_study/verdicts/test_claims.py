"""Verdicts on ensembles that obey a law exactly, that miss it, and that obey it in one reading of the paper only."""

import dataclasses

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.special import gamma as gamma_function

from support.study import LIMITS, ROOT, X, evidence
from support.workflow import FIGURES
from viscorough import reference
from viscorough_study.fits.fine_sentence import fine_grids_sentence, judged_rows
from viscorough_study.verdicts.claim import KINDS
from viscorough_study.verdicts.claims import (
    AFTER_THE_FACT,
    CLAIMS,
    COLUMNS,
    WORDS,
    counted_verdicts,
    judge,
    scale_attributes,
    verdict_on,
    verdicts_of,
)
from viscorough_study.verdicts.document import document

NAMED = {claim.name: claim for claim in CLAIMS}


@pytest.fixture(scope="module")
def table():
    return judge(evidence())


def words(sample, *names):
    """Return {name of a claim: word of its verdict} by some evidence."""
    verdicts = verdicts_of(judge(sample, [NAMED[name] for name in names]))
    return {name: verdict.word for name, verdict in verdicts.items()}


def test_every_claim_is_judged_and_shown(table):
    assert len(NAMED) == len(CLAIMS) <= 28
    assert {claim.kind for claim in CLAIMS} == set(KINDS)
    assert {claim.figure for claim in CLAIMS} <= set(FIGURES)
    assert all(claim.title[-1] != "." and claim.stated_reason for claim in CLAIMS)
    assert list(dict.fromkeys(table["claim"])) == list(NAMED)
    assert set(table["verdict"]) <= {"holds", "undecided", "not"}
    readings = {name: set(rows["reading"]) for name, rows in table.groupby("claim")}
    assert readings == {name: {"A", "B"} if claim.readings else {""} for name, claim in NAMED.items()}


def test_verdicts_on_surfaces_that_obey_equation_4(table):
    verdicts = {name: verdict.word for name, verdict in verdicts_of(table).items()}
    held = ("collapse", "separation", "last_region", "complete_contact", "power_law", "beta", "beta_lines", "coincide")
    held += ("zeta_elastic", "equivalence", "identities", "exponent_limit", "exact_correspondence", "line_area")
    assert {verdicts[name] for name in held} == {"holds"}
    missed = ("master_curve", "line_master_curve", "zeta_better", "gamma", "line_spectrum")  # lines equal discs here
    assert {verdicts[name] for name in missed} == {"not"}
    depth = table[table["claim"] == "depth"]["value"]
    assert (depth < 1).all(), "while one element touches less depth is gained than by the power law from zero on"
    exact = table[table["claim"] == "zeta_elastic"]
    np.testing.assert_allclose(exact["value"], exact["expected"], rtol=0.02)


def test_factor_of_equation_9_belongs_to_equation_11():
    """With the factor Γ in the law ζ = 2 − H; without the factor the same curves have ζ = (2 − H) Γ(2 − α)."""
    sample = evidence(lambda hurst: (2 - hurst) * gamma_function(2 - reference.exponent_alpha(hurst)))
    laws = ("master_curve", "line_master_curve", "master_curve_shape", "one_constant", "zeta_better", "zeta_elastic")
    assert words(sample, *laws) == dict.fromkeys(laws, "holds") | {"zeta_elastic": "not"}


def test_claim_may_hold_in_one_reading_only():
    in_b = evidence(lambda hurst: 1.3 * reference.zeta_elastic(hurst), square=1 / 1.3)
    (verdict,) = verdicts_of(judge(in_b, [NAMED["zeta_elastic"]])).values()
    assert (verdict.word, verdict.columns) == ("holds in B", {"A": "not", "B": "holds"})
    assert AFTER_THE_FACT in verdict.text
    in_a = evidence(square=1.3)
    (verdict,) = verdicts_of(judge(in_a, [NAMED["zeta_elastic"]])).values()
    assert (verdict.word, verdict.text) == ("holds in A", "holds in A")


def test_fits_in_other_conventions_do_not_enter_a_verdict(table):
    """Rows of other kinds of mean, windows, heights and surfaces are far from every law."""
    sample = evidence()
    scaling = sample.tables["scaling"]
    numbers = scaling.select_dtypes("number").columns.difference(["hurst", "realizations"])
    shown = {"average": "geometric", "window_rule": "default"}
    others = [scaling.assign(**{name: "another"}) for name in (*shown, "rms_convention", "group")]
    others = [other.assign(**{name: 3 * other[name] for name in numbers}) for other in others]
    sample.tables["scaling"] = pd.concat([scaling, *others], ignore_index=True)
    pd.testing.assert_frame_equal(judge(sample), table)


def test_readings_without_discs_have_no_column():
    sample = evidence()
    only_a = dataclasses.replace(sample, discs=sample.discs.sel(realization=sample.discs["group"] == "base"))
    (verdict,) = verdicts_of(judge(only_a, [NAMED["beta"]])).values()
    assert verdict.columns == {"A": "holds"}


def test_one_constant_is_judged_without_its_value():
    """1.4 times Eq. 12 meets the law up to one constant, but not as printed. A constant ζ meets none."""
    names = "master_curve", "one_constant"

    def prefactor(hurst):
        return (2 - hurst) * gamma_function(2 - reference.exponent_alpha(hurst))

    scaled = evidence(lambda hurst: prefactor(hurst) / 1.4)
    assert words(scaled, *names) == dict(zip(names, ("not", "holds"), strict=True))
    notes = judge(scaled, [NAMED["one_constant"]]).set_index(["case", "reading"])["note"]
    assert notes["constant on vt/h", "A"].startswith("constant 1.4")
    assert words(evidence(lambda hurst: 0.5 + 0 * hurst), *names) == dict.fromkeys(names, "not")


def test_assumptions_are_marked(table):
    reasons = table.drop_duplicates("claim").set_index("claim")["reason"]
    marked = reasons.str.startswith("assumption").to_dict()
    assert marked == {name: claim.assumption for name, claim in NAMED.items()}


def test_scatter_of_combinations_is_detected():
    wide = evidence()
    first = wide.discs["ensemble"] == "c0"
    wide.discs["stiffness"] = wide.discs["stiffness"] * xr.where(first, xr.DataArray(0 * X + 0.5, dims="abscissa"), 1)
    assert words(wide, "collapse") == {"collapse": "not"}


def test_scatter_of_few_realizations_does_not_count_for_combinations():
    """20 realizations that scatter by 0.5 shift means of combinations by 0.1, a third of the effect of H."""
    few = judge(evidence(scatter=0.5), [NAMED["collapse"]])
    assert verdict_on(few).word == "undecided"
    assert (few["low"] == 0).all()


def test_interval_decides_the_verdict():
    """The tolerance is 0.03: intervals inside hold, intervals outside fail, and intervals across its end are open."""
    sample = evidence()
    scaling = sample.tables["scaling"]
    rows = scaling["source"] == "discs"
    for deviation, half_width, verdict in ((0.04, 0.005, "not"), (0.04, 0.05, "undecided"), (0.01, 0.015, "holds")):
        law = reference.exponent_beta(scaling.loc[rows, "hurst"])
        for name, shift in (("beta", 0.0), ("beta_low", -half_width), ("beta_high", half_width)):
            scaling.loc[rows, name] = law + deviation + shift
        assert words(sample, "beta") == {"beta": verdict}


IN_PART = "in part at H = 0.6, 0.9"


@pytest.mark.parametrize(
    ("in_a", "in_b", "word", "text"),
    [
        (["holds"] * 3, ["holds"] * 3, "holds", "holds"),
        (["holds"] * 3, ["holds", "undecided", "holds"], "holds in A", "holds in A"),
        (["not"] * 3, ["holds"] * 3, "holds in B", f"holds in B; {AFTER_THE_FACT}"),
        (["not", "holds", "holds"], ["not", "not", "holds"], "in part", "in part"),
        (["not"] * 3, ["not", "holds", "holds"], "in part", f"in part in B at H = 0.6, 0.9; {AFTER_THE_FACT}"),
        (["not", "holds", "holds"], ["undecided"] * 3, "in part", "in part in A at H = 0.6, 0.9"),
        (["undecided", "holds", "holds"], ["not", "undecided", "undecided"], "undecided", "undecided in A at H = 0.4"),
        (["not", "undecided", "undecided"], ["not"] * 3, "not", "not"),
        (["not", "holds", "holds"], None, "in part", IN_PART),
    ],
)
def test_verdict_on_a_claim_follows_from_both_columns(table, in_a, in_b, word, text):
    rows = table[table["claim"] == "zeta_elastic"]
    rows = pd.concat([rows[rows["reading"] == name].assign(verdict=v) for name, v in (("A", in_a), ("B", in_b)) if v])
    verdict = verdict_on(rows)
    assert (verdict.word, verdict.text) == (word, text)
    assert word in WORDS
    assert (verdict.columns["A"] == IN_PART) == (in_a == ["not", "holds", "holds"])


def test_claims_without_a_region_are_undecided():
    few = dataclasses.replace(evidence(), limits=LIMITS | {"elements_min": 10**9})
    names = ("collapse", "depth")
    rows = judge(few, [NAMED[name] for name in names])
    assert set(rows["verdict"]) == {"undecided"}
    assert rows["value"].isna().all()


def test_counts_are_of_one_kind_of_claims(table):
    for kind in ("own", "quoted"):
        counted = counted_verdicts(table, kind)
        assert sum(number for _, number in counted) == sum(claim.kind == kind for claim in CLAIMS)
        assert [word for word, _ in counted] == sorted((word for word, _ in counted), key=WORDS.index)


def test_document_has_every_claim(table):
    text = document(table, "A sentence on fine grids.")
    for claim in NAMED.values():
        assert text.count(f"| {claim.title} (") == 1


def test_published_verdicts_are_the_page_of_the_documentation():
    published = pd.read_csv(ROOT / "docs/claims.csv", keep_default_na=False, na_values={c: [""] for c in NUMBERS_OF})
    assert (ROOT / "docs/verdicts.md").read_text(encoding="utf-8") == document(published, SENTENCE)


SENTENCE = fine_grids_sentence(judged_rows(ROOT))
NUMBERS_OF = [name for name, (_, unit) in COLUMNS.items() if unit]


@pytest.mark.parametrize(("across", "trial"), [(129, 0), (127, 1)])
def test_attributes_state_the_scale_and_mark_trial_runs(across, trial):
    fewer = evidence().discs.isel(realization=slice(6, None))  # fewer realizations of the first Hurst exponent
    attributes = scale_attributes(dataclasses.replace(evidence(), across=across, discs=fewer))
    names = ("elements_across", "paper_elements_across", "realizations")
    assert [attributes[name] for name in names] == [across, 257, 74]
    assert attributes["trial"] == trial
    assert ("mean nothing" in attributes["scale"]) == trial
