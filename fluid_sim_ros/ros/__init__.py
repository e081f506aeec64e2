# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 node, its topics and parameters, and example controllers."""

import sys

from fluid_sim_ros.ros.process.signals import end_quietly

# a node that is run with -m is called so while Python looks for it; loading it takes a second
if sys.argv[:1] == ['-m']:
    end_quietly()
