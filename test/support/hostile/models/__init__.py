"""Models that load, drawn over all keys of the plugins, and states that are none."""
