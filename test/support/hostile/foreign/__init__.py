"""Hostile files of other software, and of a user's settings: what reads them, and what it does."""
