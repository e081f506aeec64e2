# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models that load, drawn over all keys of the plugins, and states that are none."""
