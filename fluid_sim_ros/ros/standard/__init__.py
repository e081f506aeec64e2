# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Services of ROS's package simulation_interfaces, as other simulators offer them, too."""
