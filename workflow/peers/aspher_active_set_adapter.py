"""ASPHER's nested solution for light contact: hierarchical operators on what can touch, in single precision.

Called as: python aspher_active_set_adapter.py request.npz answer.npz (see exchange.py).
"""

from aspher_nested_adapter import AspherNested
from exchange import answer_request


class AspherActiveSet(AspherNested):
    """The mode that is fastest where few elements touch; sides of a power of two give the deepest cascade."""

    def solve(self, level, tolerance, start):
        return self.nested(level, tolerance, backend="h2", precision="float", active_set=True)


if __name__ == "__main__":
    answer_request("aspher", AspherActiveSet)
