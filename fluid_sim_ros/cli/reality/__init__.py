# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommands that hold a model against real flights: compare, fit, excite."""
