# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Files that lie: made by mutation of honest ones and from scratch, and a judge of what became."""
