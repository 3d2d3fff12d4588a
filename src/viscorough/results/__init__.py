"""Results of computations: the classes LoadingCurve, Contact and Motion."""
