# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the node knows and says of how it fares: diagnostics, and the watches behind them."""
