# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The Python example of the README runs, and shows a vehicle that moves."""

import re
import subprocess
import sys

from test.support.paths import ROOT


def test_the_python_example_of_the_readme_prints_no_zeros():
    (example,) = re.findall(r'```python\n(.*?)```', (ROOT / 'README.md').read_text(), re.DOTALL)
    done = subprocess.run(
        [sys.executable, '-c', example], capture_output=True, text=True, check=True, cwd=ROOT
    )
    first, *terms = done.stdout.splitlines()
    position, velocity = re.findall(r'\[(.*?)\]', first)
    assert float(position.split()[0]) > 0.1
    assert float(velocity.split()[0]) > 0.1
    assert [line.split()[0] for line in terms] == ['added_mass', 'buoyancy', 'damping']
