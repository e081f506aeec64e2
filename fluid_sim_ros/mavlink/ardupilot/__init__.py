# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ArduPilot: JSON over UDP, in lockstep led by the autopilot."""
