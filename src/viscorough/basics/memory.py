"""Check the available memory, so that problems that are too large are refused before anything is allocated."""

import psutil


def require(needed: float, purpose: str) -> None:
    """Raise MemoryError, which states the needed and the available memory, unless `needed` bytes are available.

    purpose : name of the object that needs the memory; the message starts with this name
    """
    available = psutil.virtual_memory().available
    if needed > available:
        raise MemoryError(f"{purpose} takes {needed:.3g} bytes of memory, {available:.3g} bytes are available")
