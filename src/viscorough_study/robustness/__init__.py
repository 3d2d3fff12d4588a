"""Stress tests of all methods: in which cases a method fails, and whether it reports the failure."""
