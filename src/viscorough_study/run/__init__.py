"""One run: its settings, cases, seeds, tables, digests, logs and locks."""
