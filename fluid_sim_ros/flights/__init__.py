# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flights of real vehicles, by any software, in one form: signals with time, unit and axes."""
