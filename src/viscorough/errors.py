"""The errors and warnings of the package that users may want to catch."""


class ConvergenceError(RuntimeError):
    """A solver did not reach the accuracy asked for; no result is returned."""


class AccuracyWarning(UserWarning):
    """A result may be less accurate than expected; the message says why and what helps."""
