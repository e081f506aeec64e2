# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A tether in a current against the equations of a line, and a slung load against the pendulum.

The tether of ``bluerov2_tether`` (16 m in 16 segments) is tied to a second fixed point instead of
its vehicle and left alone in a uniform current for 20 s; SciPy solves the boundary problem of an
inextensible cable with drag across and along (``test/support/tether_equations.py``). Compared are
all joints and the pull on the end. "between" turns every segment by 22.5 degrees about the tether,
where the drag of its two axes fits worst. The load of ``x500_slung_load`` swings under a vehicle
that is held. Targets: shape within 0.3 % of the length, pull within 5 %, period within 0.1 % at
0.05 rad.
"""

from typing import Any

import numpy as np

from benchmarks.common import arguments, write
from test.support.slung_runs import exact_period, pendulum
from test.support.tether_equations import Cable, shape
from test.support.tether_runs import ANCHOR, LENGTH, SEGMENTS, settled

SLACK, TIGHT = (8.0, 0.0, -4.95), (14.5, 0.0, -4.95)
CASES = {
    'slack, across': (SLACK, (0.0, 1.0, 0.0), 0.0),
    'slack, across, slow': (SLACK, (0.0, 0.3, 0.0), 0.0),
    'slack, aslant': (SLACK, (0.6, 0.8, 0.0), 0.0),
    'slack, aslant, between': (SLACK, (0.6, 0.8, 0.0), np.pi / 8),
    'nearly taut, across': (TIGHT, (0.0, 1.0, 0.0), 0.0),
    'nearly taut, aslant': (TIGHT, (0.3, 0.4, 0.0), 0.0),
}


def tether(end: Any, current: Any, roll: float, seconds: float) -> dict[str, float]:
    """Return how far the tether is from the equations."""
    places, pull, speed = settled(end, np.array(current), seconds, roll)
    expected, forces = shape(Cable(), ANCHOR, end, current, SEGMENTS + 1)
    apart = float(np.linalg.norm(places - expected, axis=1).max())
    exact = float(np.linalg.norm(forces[1]))
    return {
        'shape_error_m': apart,
        'shape_error_of_length': apart / (SEGMENTS * LENGTH),
        'pull_n': float(np.linalg.norm(pull)),
        'pull_exact_n': exact,
        'pull_error': float(np.linalg.norm(pull - forces[1])) / exact,
        'speed_m_s': speed,
    }


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'tether')
    seconds = 10.0 if options.quick else 20.0
    cases = {name: tether(*case, seconds) for name, case in CASES.items()}
    periods = {
        f'{angle:g} rad': {
            'period_s': pendulum(angle), 'exact_s': float(exact_period(angle)),
            'error': float(pendulum(angle) / exact_period(angle) - 1),
        }
        for angle in (0.05, 0.2, 0.5)
    }  # fmt: skip
    for name, row in cases.items():
        print(f'{name}: {row["shape_error_m"] * 1e3:.1f} mm, pull {row["pull_error"]:.2%}')
    for name, row in periods.items():
        print(f'pendulum, {name}: {row["error"]:.2e}')
    write(options.json, {'tether': cases, 'pendulum': periods})


if __name__ == '__main__':
    main()
