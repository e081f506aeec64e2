# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Scenes of several vehicles, each of a model of its own: read, composed and checked."""
