# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Fluid forces in plain numpy: readable, slow, the oracle for the C++ plugins.

Every function is pure, takes SI units and broadcasts over leading dimensions: vectors have shape
(..., 3), scalars (...). The axes are those of the body (or ellipsoid, or box), velocities are
relative to the undisturbed medium, forces act on the body. No function imports MuJoCo or ROS.
"""
