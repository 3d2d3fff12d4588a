"""Check the available memory, so that problems that are too large are refused before anything is allocated."""

import psutil


def require(needed: float, purpose: str) -> None:
    """Raise MemoryError, which names both numbers, unless `needed` bytes are available for a purpose."""
    available = psutil.virtual_memory().available
    if needed > available:
        raise MemoryError(f"{purpose} takes {needed:.3g} bytes of memory, {available:.3g} bytes are available")
