"""Watch the files that a job of Snakemake opens. Python imports this module at its start, since PYTHONPATH names it."""

import sys

if any(".snakemake/scripts/" in word for word in sys.orig_argv[:2]):
    import atexit

    from undeclared_files import watch, write_undeclared

    opened = watch()
    atexit.register(lambda: write_undeclared(sys.modules["__main__"].__dict__.get("snakemake"), opened))
