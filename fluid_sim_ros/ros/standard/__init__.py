"""Services of ROS's package simulation_interfaces, as other simulators offer them, too."""
