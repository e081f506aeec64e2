"""ROS 2 messages as bytes, without ROS: CDR readers and templates, definitions, state topics."""
