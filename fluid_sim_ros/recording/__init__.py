# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs: recording to MCAP, reading, replay, plots and pictures; works without ROS."""
