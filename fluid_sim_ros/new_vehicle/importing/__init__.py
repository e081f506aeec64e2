"""Makes the files of a vehicle from a URDF, an MJCF model or a mesh."""
