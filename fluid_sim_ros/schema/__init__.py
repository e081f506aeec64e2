# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What scene, vehicle, sensor and weather files may say, and the settings of a run."""
