# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
``fluid_sim demo``: a quadrotor holds its place in a gust, over real ROS 2.

``flight`` runs simulator and controller as two processes, ``flight_log`` reads what the simulator
recorded and flies it again, ``summary`` and ``plots`` show it, ``main`` is the command.
"""
