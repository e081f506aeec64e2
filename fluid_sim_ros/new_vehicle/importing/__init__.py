# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Makes the files of a vehicle from a URDF, an MJCF model or a mesh."""
