"""Stress tests of all methods: where a method fails, and whether it reports the failure."""
