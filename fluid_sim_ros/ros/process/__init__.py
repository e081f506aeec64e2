# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A node as a process: its command line, signals, executor thread, and an orderly end."""
