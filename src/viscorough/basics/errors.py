"""Define the errors and warnings that users may want to catch, and write the messages of errors."""


class ConvergenceError(RuntimeError):
    """A solver did not reach the requested accuracy; no result is returned.

    Examples
    --------
    >>> import viscorough
    >>> issubclass(viscorough.ConvergenceError, RuntimeError)
    True
    """


class AccuracyWarning(UserWarning):
    """A result may be less accurate than expected; the message states the reason and the remedy.

    Examples
    --------
    >>> import warnings
    >>> import viscorough
    >>> warnings.simplefilter("error", viscorough.AccuracyWarning)  # a doubtful result raises
    >>> warnings.simplefilter("default", viscorough.AccuracyWarning)
    """


# The command line reports errors of these types in one line. An error of any other type is a fault of viscorough.
REPORTED = (ValueError, OSError, MemoryError, Warning, ConvergenceError)


def message(error: BaseException) -> str:
    """Return the message of an error without a full stop."""
    text = str(error)
    if isinstance(error, MemoryError):
        text = f"not enough memory{f' ({text})' if text else ''}; a smaller map of heights is needed"
    return text.strip().removesuffix(".")
