"""The public names, for tools that read types; `__init__.py` imports them on first use."""

from viscorough import reference as reference
from viscorough.calibrated_law import penetration_law as penetration_law
from viscorough.contact.loading_path import indent as indent
from viscorough.contact.one_contact import contact_at as contact_at
from viscorough.contact.options import SolverOptions as SolverOptions
from viscorough.contact_maps import Contact as Contact
from viscorough.errors import AccuracyWarning as AccuracyWarning
from viscorough.errors import ConvergenceError as ConvergenceError
from viscorough.estimates import estimate as estimate
from viscorough.indenter import Indenter as Indenter
from viscorough.io.heights import read_heights as read_heights
from viscorough.io.media import read_medium as read_medium
from viscorough.io.motion import read_force_history as read_force_history
from viscorough.io.saving import load_curve as load_curve
from viscorough.io.saving import save_curve as save_curve
from viscorough.io.saving import save_heights as save_heights
from viscorough.io.surfaces import read_line as read_line
from viscorough.loading_curve import LoadingCurve as LoadingCurve
from viscorough.mdr import line_of_map as line_of_map
from viscorough.mdr import line_of_surface as line_of_surface
from viscorough.mdr import reduce as reduce
from viscorough.preparation import prepare as prepare
from viscorough.surfaces import cut_disc as cut_disc
from viscorough.surfaces import self_affine_disc as self_affine_disc
from viscorough.surfaces import self_affine_line as self_affine_line
from viscorough.viscous.correspondence import ForceHistory as ForceHistory
from viscorough.viscous.correspondence import impulses as impulses
from viscorough.viscous.correspondence import kinetics as kinetics
from viscorough.viscous.integration.events import march_events as march_events
from viscorough.viscous.integration.internal_variable_events import march_medium_events as march_medium_events
from viscorough.viscous.integration.internal_variables import march_medium as march_medium
from viscorough.viscous.integration.stepping import march_steps as march_steps
from viscorough.viscous.media import CreepTable as CreepTable
from viscorough.viscous.media import KelvinVoigt as KelvinVoigt
from viscorough.viscous.media import Maxwell as Maxwell
from viscorough.viscous.media import Newtonian as Newtonian
from viscorough.viscous.media import Prony as Prony
from viscorough.viscous.media import Springpot as Springpot
from viscorough.viscous.media import StandardLinearSolid as StandardLinearSolid
from viscorough.viscous.medium import Medium as Medium
from viscorough.viscous.pressures import pressure_at as pressure_at
from viscorough.viscous.relaxation import force_under_depth as force_under_depth

__version__: str
