# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ROS parameters: tables that declare, check and document them, and the files that set them.

``simulator`` holds the table of the simulator's node, ``table`` what all tables share, ``files``
what is checked before ROS reads a file.
"""
