"""States live to Foxglove and Lichtblick, without ROS: the channels and schemas of a log."""
