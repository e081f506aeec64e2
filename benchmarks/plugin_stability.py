"""Kinetic energy of body and fluid over m_A/m and integrator; the lagged method beside it."""
