# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import sys

import pytest

from test.support.paths import ROOT


@pytest.fixture(scope='session')
def egg_info(tmp_path_factory):
    """Return the metadata that setup.py yields, as pip and colcon read it."""
    folder = tmp_path_factory.mktemp('metadata')
    subprocess.run(
        [sys.executable, 'setup.py', '-q', 'egg_info', '--egg-base', str(folder)],
        cwd=ROOT, check=True, capture_output=True, env={**os.environ, 'PYTHONPATH': ''},
    )  # fmt: skip
    return folder / 'fluid_sim_ros.egg-info'
