"""Terminal velocity of spheres over Re .1 to 1e5: own formula and the standard drag curve."""
