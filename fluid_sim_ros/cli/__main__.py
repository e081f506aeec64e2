"""Runs ``python -m fluid_sim_ros.cli``."""

import sys

from fluid_sim_ros.cli import main

sys.exit(main())
