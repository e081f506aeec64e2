# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Parameter sweeps and Monte Carlo: many short runs of one scene, with different numbers.

``sweep_file`` reads what is varied and gives each run its numbers, ``flight`` runs one,
``results`` keeps the rows, and ``run_sweep`` hands the runs to threads or to Ray.
"""
