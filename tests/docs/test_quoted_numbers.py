"""Numbers and verdicts that README and docs quote are those of the published tables."""

import re

import numpy as np
import pandas as pd
import yaml

from support.documentation import ROOT, read
from viscorough_study.fits.fine_sentence import fine_grids_sentence, judged_rows

CLAIMS = pd.read_csv(ROOT / "docs/claims.csv")
VALUE = CLAIMS.assign(reading=CLAIMS["reading"].fillna("")).set_index(["claim", "reading", "case"])


def words(page):
    """Return the text of a page with single spaces."""
    return re.sub(r"\s+", " ", read(ROOT / page))


def departure(claim, case):
    """Return β − H/(1 + H) of a case in reading A."""
    row = VALUE.loc[(claim, "A", case)]
    return row["value"] - row["expected"]


def quoted():
    """Yield (page, text) for every quoted number, with the number of the published table."""
    within = max(abs(departure("beta", case)) for case in ("H = 0.6", "H = 0.9"))
    yield "README.md", f"H/(1 + H) within {np.ceil(100 * within) / 100:.2f} at H = 0.6 and 0.9"
    small = [departure("exponent_small_hurst", case) for case in ("H = 0.1", "H = 0.4")]
    yield "README.md", "larger by {:.2f} at H = 0.1 and by {:.2f} at H = 0.4".format(*small)
    eq_12 = max(VALUE.loc[("master_curve", "B", f"H = {hurst}"), "value"] for hurst in (0.4, 0.6, 0.9))
    yield "README.md", f"less Eq. 12 is at most {np.ceil(100 * eq_12) / 100:.2f}"
    constant = VALUE.loc[("one_constant", "A", "constant on vt/h"), "note"].split()[1]
    yield "README.md", f"Eq. 12 must be multiplied by {constant}"
    verdict = VALUE.loc[("beta", "B", "H = 0.6"), "verdict"]
    yield "README.md", f"larger square leave the exponent at H = 0.6 {verdict}"
    minutes = yaml.safe_load(read(ROOT / "resources/published/default_run.yaml"))["minutes"]
    yield "README.md", f"several weeks in the paper, {minutes} minutes here"


def test_sentence_on_fine_grids_is_the_same_everywhere():
    sentence = fine_grids_sentence(judged_rows(ROOT))
    for page in ("README.md", "docs/verification.md", "docs/verdicts.md"):
        assert sentence in words(page)


def test_quoted_numbers_are_those_of_the_published_tables():
    for page, text in quoted():
        assert text in words(page)
