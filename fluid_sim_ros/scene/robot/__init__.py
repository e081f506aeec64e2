"""A vehicle as ROS describes robots: links and joints, and the URDF of them."""
