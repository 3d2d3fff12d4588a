"""Stand-in for SlipPY: the part of its interface that the adapter uses, solved exactly by a dense matrix."""

CUDA, CORES = True, None
