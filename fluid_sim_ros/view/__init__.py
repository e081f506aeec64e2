# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A live view: sources of frames, a page in the browser, the desktop viewer."""
