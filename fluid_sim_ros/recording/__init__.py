"""Logs: recording to MCAP, reading, replay, plots and pictures; works without ROS."""
