"""Meshes of strangers: read within limits, repaired with a word, or refused in one line."""
