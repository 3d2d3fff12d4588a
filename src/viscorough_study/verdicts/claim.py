"""A claim: a sentence that can be tested, the criterion of its verdict, and the function that yields numbers to judge.

A claim is written as a function beside its sentence:

    @claim(title="…", sentence="…", …, tolerance=0.03)
    def beta(evidence, tolerance):
        yield …

The function takes the evidence (verdicts.evidence.Evidence) and the tolerance, and yields the cases of the claim, such
as one case for each Hurst exponent. `verdicts.claims.CLAIMS` lists all claims.

No tolerance was registered before the first results were computed. A reason says so if a tolerance was set or changed
while the numbers that it judges were known. Only the text of the paper was available. Tolerances that rest on the look
of a printed figure are therefore marked as assumptions: a line or the size of a symbol is assumed to cover about 2 % of
an axis, which is 0.01 to 0.03 on the axis of β in Fig. 4, and a tenth of a decade (25 %) in Figs. 2 and 3.
"""

from collections.abc import Callable
from dataclasses import dataclass

KINDS = {
    "own": "The paper's own claims",
    "quoted": "Claims that it quotes from earlier work",
    "beyond": "Beyond the paper (not counted)",
    "identity": "Identities (not counted)",
}


@dataclass(frozen=True)
class Claim:
    """A claim with all that is said about it.

    judge : function of the evidence and the tolerance that yields the cases of the claim
    title : the claim in a few plain words, which can follow "that"
    sentence : what is claimed, in our words, with the hedges of the paper in quotation marks
    where : section, equation or figure of the paper
    kind : key of `KINDS`
    quantity : what the numbers of its cases are
    criterion : when a case holds
    tolerance, reason : tolerance of the criterion, and why it is what it is
    figure : name of the figure that shows the claim
    remark : what a reader needs to know to understand the verdict
    assumption : True if the tolerance rests on how a printed figure of the paper looks
    readings : True if the claim depends on how the discs were made, which the paper does not say. It is then judged in
        both readings (viscorough_study.fits.conventions.READINGS)
    """

    judge: Callable
    title: str
    sentence: str
    where: str
    kind: str
    quantity: str
    criterion: str
    tolerance: float
    reason: str
    figure: str
    remark: str = ""
    assumption: bool = False
    readings: bool = False

    @property
    def name(self):
        """Return the name of the function, which is the name of the claim in tables."""
        return self.judge.__name__

    @property
    def stated_reason(self):
        """Return the reason for the tolerance, marked if it is an assumption."""
        return "assumption: " * self.assumption + self.reason


def claim(**described):
    """Return a decorator that makes a Claim of a function; described : fields of `Claim`."""
    return lambda judge: Claim(judge, **described)
