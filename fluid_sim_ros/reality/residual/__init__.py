# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the accelerations of a model lack along a flight, in numbers and in words."""
