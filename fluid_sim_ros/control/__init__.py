# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Control laws: plain numbers in, plain numbers out; no ROS, no MuJoCo, no clock of their own."""
