"""The registry of criteria: by which function each claim in resources/paper/claims.yaml is judged.

A criterion is a function of the evidence (viscorough_study.evidence.Evidence) and the tolerance of the claim; it
returns the cases of the claim (`judged`). Every module of criteria has a mapping JUDGES, {claim: criterion}.

With other random surfaces the numbers differ, and a verdict must not depend on them: where a quantity has a 95 %
interval, the claim is reproduced only if the whole interval lies within what the tolerance allows, and not reproduced
only if it lies wholly outside; otherwise it is undecided. How the number of cases and that of realizations enter is
said at viscorough_study.evidence.Evidence.within.
"""

from viscorough_study import (
    form_criteria,
    law_criteria,
    mdr_criteria,
    method_criteria,
    region_criteria,
    zeta_criteria,
)

MODULES = form_criteria, region_criteria, law_criteria, zeta_criteria, method_criteria, mdr_criteria
JUDGES = {claim: criterion for module in MODULES for claim, criterion in module.JUDGES.items()}
