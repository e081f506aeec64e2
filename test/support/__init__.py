# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What tests and benchmarks share: models, equations of motion, flights, processes."""
