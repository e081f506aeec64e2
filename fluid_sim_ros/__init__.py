"""ROS 2 simulator for aerial and underwater vehicles: MuJoCo with fluid forces."""

