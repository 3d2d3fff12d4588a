"""Solve the contacts of measured surfaces with an elastic half-space."""

from viscorough_study.comparisons.measured_contacts import CONTACTS, measured_contacts
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, *, scans):
    """Write the table of the contacts of all scans under their forces.

    csv : file to write; scans : argument of `measured_contacts`
    """
    title = "Contacts of measured surfaces"
    table = measured_contacts(scans)
    write_table(table, csv, columns=CONTACTS, title=title)


run_job(globals(), main)
