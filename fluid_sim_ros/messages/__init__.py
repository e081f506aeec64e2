# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ROS 2 messages as bytes, without ROS: CDR readers and templates, definitions, state topics."""
