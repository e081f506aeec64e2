# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The advisor: the cheapest setting of a scene that is accurate enough."""
