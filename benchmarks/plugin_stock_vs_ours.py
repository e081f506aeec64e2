"""Stock MuJoCo against fluid_sim: the accuracy table of the README."""
