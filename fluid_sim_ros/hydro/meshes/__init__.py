# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Meshes of strangers: read within limits, repaired with a word, or refused in one line."""
