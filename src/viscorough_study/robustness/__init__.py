"""Tests of where the methods fail, and whether they report their failures."""
