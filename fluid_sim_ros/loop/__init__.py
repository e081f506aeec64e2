"""The loop around a simulation: commands in, states out, at a pace."""
