# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The model of a log: its files gathered, kept apart from the disk, and loaded for a trial."""
