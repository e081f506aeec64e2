# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs ``python -m fluid_sim_ros.cli``."""

from fluid_sim_ros.cli import main
from fluid_sim_ros.interruption import leave

leave(main())
