"""Scenes of several vehicles, each of a model of its own: read, composed and checked."""
