"""The ROS 2 node, its topics and parameters, and example controllers."""
