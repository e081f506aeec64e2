# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Manoeuvres that make parameters felt: planned, flown by a model, written, and judged."""
