"""Width of the border that surrounds the elements in flat fields.

A flat field has a value for every place of the grid and of its border. No element lies in the border, so loops and the
preconditioner can read the neighbours of an element at the edge of the grid without a special case. The width is a
constant of functions that `njit` compiles.
"""

# Rows and columns on each side. The preconditioner reads neighbours up to this distance.
BORDER = 2
