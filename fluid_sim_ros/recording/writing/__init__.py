"""Writing logs: MCAP files, and what rosbag2 wants beside them, in a process of its own."""
