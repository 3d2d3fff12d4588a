"""Check of the available memory, so that problems too large for it are refused before anything is allocated."""

import psutil


def require(needed: float, what: str) -> None:
    """Raise MemoryError, which names both numbers, unless `needed` bytes are available for `what`."""
    available = psutil.virtual_memory().available
    if needed > available:
        raise MemoryError(f"{what} takes {needed:.3g} bytes of memory, {available:.3g} bytes are available")
