# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Stand-ins for autopilots, readers of what goes over the wire, recordings of real ones."""
