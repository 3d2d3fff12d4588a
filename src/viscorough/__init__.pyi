"""Public names and their modules, read by type checkers and by `__init__.py`, which imports a name at its first use."""

from viscorough import reference as reference
from viscorough.basics.errors import AccuracyWarning as AccuracyWarning
from viscorough.basics.errors import ConvergenceError as ConvergenceError
from viscorough.contact.loading_path import indent as indent
from viscorough.contact.one_contact import contact_at as contact_at
from viscorough.contact.options import SolverOptions as SolverOptions
from viscorough.io.heights import read_heights as read_heights
from viscorough.io.heights import read_line as read_line
from viscorough.io.histories import read_load as read_load
from viscorough.io.medium_files import read_medium as read_medium
from viscorough.io.plotting import plot as plot
from viscorough.io.result_datasets import to_dataset as to_dataset
from viscorough.io.saving import load_curve as load_curve
from viscorough.io.saving import save as save
from viscorough.law.calibrated_law import penetration_law as penetration_law
from viscorough.mdr import reduce as reduce
from viscorough.media.kinds import KelvinVoigt as KelvinVoigt
from viscorough.media.kinds import Maxwell as Maxwell
from viscorough.media.kinds import Newtonian as Newtonian
from viscorough.media.kinds import Prony as Prony
from viscorough.media.kinds import Springpot as Springpot
from viscorough.media.kinds import StandardLinearSolid as StandardLinearSolid
from viscorough.media.load import Load as Load
from viscorough.results.contact_maps import Contact as Contact
from viscorough.results.loading_curve import LoadingCurve as LoadingCurve
from viscorough.results.motion import Motion as Motion
from viscorough.surfaces.indenter import Indenter as Indenter
from viscorough.surfaces.lines import self_affine_line as self_affine_line
from viscorough.surfaces.preparation import prepare as prepare
from viscorough.surfaces.self_affine import self_affine_disc as self_affine_disc
from viscorough.viscous.estimate import estimate as estimate
from viscorough.viscous.integration.march import march as march
from viscorough.viscous.kinetics import kinetics as kinetics

__version__: str
