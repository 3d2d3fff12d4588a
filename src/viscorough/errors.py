"""The errors and warnings of the package that users may want to catch."""


class ConvergenceError(RuntimeError):
    """A solver did not reach the accuracy asked for; no result is returned."""


class AccuracyWarning(UserWarning):
    """A result is less accurate than users would expect: what happened, and what helps."""
