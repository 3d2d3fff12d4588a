"""Write the verdicts on all claims as a page of the documentation, in Markdown (docs/verdicts.md)."""

from viscorough_study.verdicts.claim import KINDS
from viscorough_study.verdicts.claims import AFTER_THE_FACT, CLAIMS, counted_verdicts, verdicts_of

HEAD = f"""\
# Verdicts on the paper's claims

These are the verdicts of a run; the documentation has those of the default run, `make reproduce`. The page of the run,
`results/index.html`, has each claim with its numbers, criterion and remarks beside the picture that shows it.
[claims.csv](claims.csv) is the full table, with values, 95 % intervals, tolerances and their reasons. Symbols are
defined in [Theory](theory.md#symbols).

A claim has one or several *cases*, such as one for each Hurst exponent. A case *holds* if the whole 95 % interval of
its number lies within the tolerance, it does *not* hold if the whole interval lies outside, and it is *undecided*
otherwise. A claim holds *in part* if some of its cases hold and others do not; otherwise it has the worst verdict of
its cases.

The paper does not say how its discs were made. Claims that depend on this are judged in two *readings*. In *A* the
spectrum has the period *L*, the diameter, and *h* is the rms height of the disc. In *B* the disc is cut from a square
of twice its diameter, and *h* is the rms height of the square. If both readings give the same verdict, this is the
verdict. If the claim holds in one of them, it *holds in A* or *holds in B*. Otherwise the better verdict counts, with
the reading named. Reading A was chosen first. A verdict that rests on B was {AFTER_THE_FACT}.
Claims with empty columns do not depend on the reading, or are judged in A only; these are all claims on lines of the
method of dimensionality reduction (MDR), which are compared with reading A. Reading B has fewer discs,
so that some of its cases are undecided for their wider intervals.

What the paper says on computing time is on the page beside our times, and no claim here: times belong to a machine.

Two rules make a verdict independent of the surfaces that happen to be drawn. A case fails only if its interval lies
outside even when it is widened so that the intervals of all cases of the claim hold together at 95 % (Bonferroni).
With fewer realizations than the 80 that the paper averages, a verdict must hold with intervals twenty times as wide
(Chebyshev's inequality); otherwise the case is undecided.

No tolerance was registered before the first results were computed. Only the text of the paper was available, not its
figures: a tolerance that rests on the look of a printed figure is an assumption, and says so. Means are geometric means
over the surfaces at fixed *X*, and fits extend over region (b).
"""


def document(table, fine_grids):
    """Return the page.

    table : table of verdicts (verdicts.claims.judge)
    fine_grids : sentence on the exponent on fine grids (viscorough_study.fits.fine_sentence)
    """
    parts, verdicts = [HEAD, *_counts(table), f"{fine_grids}\n"], verdicts_of(table)
    present = [claim for claim in CLAIMS if claim.name in verdicts]
    for kind, heading in KINDS.items():
        claims = [claim for claim in present if claim.kind == kind]
        if claims:
            lines = [f"## {heading}\n", "| claim | A | B | verdict |", "|---|---|---|---|"]
            lines += [_line(claim, verdicts[claim.name]) for claim in claims]
            parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def _counts(table):
    """Return a paragraph on how many claims have which verdict, for each kind of claim that is counted."""
    for kind in ("own", "quoted"):
        if counts := counted_verdicts(table, kind):
            yield f"{KINDS[kind]}: {counts_text(counts)}.\n"


def counts_text(counts):
    """Return numbers of verdicts as text, such as "holds: 6; not: 3"; counts : result of `counted_verdicts`"""
    return "; ".join(f"{word}: {number}" for word, number in counts)


def _line(claim, verdict):
    in_a, in_b = ("", "") if "" in verdict.columns else (verdict.columns.get(reading, "–") for reading in ("A", "B"))
    return f"| {claim.title} (`{claim.name}`, {claim.where}) | {in_a} | {in_b} | {verdict.text} |"
