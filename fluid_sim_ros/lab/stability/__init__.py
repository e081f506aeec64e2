"""Stability: where each integrator fails, as maps and as limits."""
