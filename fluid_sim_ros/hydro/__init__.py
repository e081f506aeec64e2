"""Hydrodynamic coefficients of a body from its closed mesh."""
