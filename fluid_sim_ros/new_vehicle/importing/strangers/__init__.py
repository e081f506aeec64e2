# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""XML of strangers: read within limits, expanded and tried in processes of their own."""
