"""Solve the contacts of measured surfaces with an elastic half-space."""

from viscorough_study.comparisons.measured import CONTACTS, measured_contacts
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, *, scans):
    """Write the table of the contacts of all scans under their forces.

    csv, nc : files to write; scans : argument of `measured_contacts`
    """
    title = "Contacts of measured surfaces"
    attributes = recorded(settings={"scans": scans})
    table = measured_contacts(scans)
    write_table(table, csv, nc, columns=CONTACTS, dimension="row", title=title, attributes=attributes)


run_job(globals(), main)
