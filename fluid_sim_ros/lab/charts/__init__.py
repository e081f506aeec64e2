# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Charts: what accuracy costs, for every model, integrator and timestep of a problem."""
