"""The ROS 2 leaf: node, messages, example controllers and the demo."""
