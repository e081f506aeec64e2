# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A small sweep, and its variants."""

from fluid_sim_ros.sweep.sweep_file import SweepFile


def sweep_of(**keys) -> SweepFile:
    keys = {'scene': 'sphere', 'duration': 0.2, 'vary': {'seed': {'values': [0]}}, **keys}
    return SweepFile.model_validate(keys)
