"""The errors and warnings of the package that users may want to catch."""


class ConvergenceError(RuntimeError):
    """A solver did not reach the accuracy asked for; no result is returned.

    Examples
    --------
    >>> import viscorough
    >>> issubclass(viscorough.ConvergenceError, RuntimeError)
    True
    """


class AccuracyWarning(UserWarning):
    """A result may be less accurate than expected; the message says why and what helps.

    Examples
    --------
    >>> import warnings
    >>> import viscorough
    >>> warnings.simplefilter("error", viscorough.AccuracyWarning)  # a doubtful result raises
    >>> warnings.simplefilter("default", viscorough.AccuracyWarning)
    """
