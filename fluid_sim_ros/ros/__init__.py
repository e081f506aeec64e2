"""The ROS 2 leaf: node, messages and example controllers."""
