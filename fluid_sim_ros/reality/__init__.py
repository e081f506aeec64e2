# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A model against real flights: compared by open-loop windows, fitted, excited."""
