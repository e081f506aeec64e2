"""The page in the browser: a guarded server, the scene, panels, plots."""
