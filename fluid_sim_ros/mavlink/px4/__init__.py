# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""PX4: MAVLink HIL over TCP, in lockstep led by the simulation."""
