# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Bridges to autopilots in lockstep: PX4 over MAVLink HIL, ArduPilot over JSON."""
