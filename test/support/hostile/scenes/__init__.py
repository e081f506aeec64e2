"""Scenes of a seed that load, drawn over the schemas of their files, and what is done with it."""
