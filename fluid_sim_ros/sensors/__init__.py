# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors of a vehicle: what they would read of the simulated state, without ROS or MAVLink."""

from fluid_sim_ros.sensors.suite import SensorSuite

__all__ = ['SensorSuite']
