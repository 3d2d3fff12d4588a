"""The study of the paper: ensembles, fits, verdicts, comparisons of methods, stress tests and figures."""
