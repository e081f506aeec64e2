"""``fluid_sim view``: the command, and the sources that need logs or ROS."""
