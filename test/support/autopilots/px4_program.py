# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The stand-in for PX4 as a program: takes off and holds its place until it is ended."""

import argparse
import os

from test.support.autopilots.px4_pilots import Quad
from test.support.autopilots.px4_stand_in import Px4


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument('-d', action='store_true')
    parser.add_argument('-i', type=int, default=0)
    instance = parser.parse_args().i
    print(f'airframe {os.environ["PX4_SYS_AUTOSTART"]}, instance {instance}', flush=True)
    px4, quad = Px4(4560 + instance), Quad((2.0, 1.0, -3.0), hover=0.77)
    controls = [0.0] * 4
    while True:
        controls = quad.controls(px4, px4.exchange(controls))


if __name__ == '__main__':
    main()
