# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Writing logs: MCAP files, and what rosbag2 wants beside them, in a process of its own."""
