"""Evaluate scans and end the process at one of them, in a module that other processes can import."""

import os

ELEMENTS_OF_THE_DEADLY = 25


def evaluate(indenter):
    """Return one row with the number of elements, or end the process as the system does when memory runs out."""
    if indenter.elements == ELEMENTS_OF_THE_DEADLY:
        os._exit(9)
    return [{"depth": float(indenter.elements)}], {"depth": "1"}
