"""Makes the files of a new vehicle from its mass, size and thrusters."""
