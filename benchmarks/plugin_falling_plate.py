"""Falling plates: where flutter turns into tumbling, with fluid_sim and with stock defaults."""
