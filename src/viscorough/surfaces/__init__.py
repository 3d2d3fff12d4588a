"""Rigid indenters: their type, and generation and preparation of their heights."""
