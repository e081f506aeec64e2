"""Manoeuvres that make parameters felt: planned, flown by a model, written, and judged."""
