# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Scenes of a seed that load, drawn over the schemas of their files, and what is done with it."""
