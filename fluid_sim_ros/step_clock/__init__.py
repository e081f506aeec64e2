# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Simulated time in whole steps, kept exactly: the clock, durations, and what recurs at a rate."""

from fluid_sim_ros.step_clock.beat import Beat
from fluid_sim_ros.step_clock.clock import Pace, StepClock
from fluid_sim_ros.step_clock.durations import (
    NEVER,
    duration_steps,
    exact,
    rounded_duration,
    rounded_steps,
    whole_steps,
)

__all__ = [
    'NEVER', 'Beat', 'Pace', 'StepClock', 'duration_steps', 'exact', 'rounded_duration',
    'rounded_steps', 'whole_steps',
]  # fmt: skip
