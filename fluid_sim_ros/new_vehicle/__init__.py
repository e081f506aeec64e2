# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Makes the files of a new vehicle from its mass, size and thrusters."""
