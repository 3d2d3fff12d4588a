"""One run: its settings, samples, seeds, tables, digests, logs and locks."""
