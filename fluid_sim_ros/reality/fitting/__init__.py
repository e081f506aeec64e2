# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The inside of a fit: windows shot from states of their own, steps, delays, and doubts."""
