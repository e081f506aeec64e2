# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""States live to Foxglove and Lichtblick, without ROS: the channels and schemas of a log."""
