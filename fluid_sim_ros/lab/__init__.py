# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The speed-accuracy laboratory: charts, stability maps, and the advisor on settings."""
