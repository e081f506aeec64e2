# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Opening a log takes little memory: what is heavy is imported where it is used."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.recording.model import trial
from test.support.hostile.trials import Trials
from test.support.recorded_flights import record_flight

#: Each takes 10 to 60 MiB.
HEAVY = (
    'matplotlib', 'scipy', 'pyarrow', 'rclpy', 'PIL', 'ray', 'trimesh', 'capytaine', 'pandas',
    'imageio_ffmpeg', 'pymavlink',
)  # fmt: skip
#: Python, numpy and MuJoCo take 50 MiB of it.
MOST_OF_A_TRIAL = 100 << 20


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=0.1, seed=1)
    return path


ACTIONS = {
    'info': 'main(["info", sys.argv[1]])',
    'export': 'main(["export", sys.argv[1], "--csv", sys.argv[2]])',
    'repair': 'main(["repair", sys.argv[1], sys.argv[2]])',
    'resimulate': 'main(["replay", sys.argv[1], "--resimulate"])',
    'trial': 'trial._load(Path(sys.argv[1]))',
}


@pytest.mark.parametrize('action', ACTIONS)
def test_opening_a_log_imports_nothing_heavy(action, log, tmp_path):
    script = (
        'import sys\nfrom pathlib import Path\nfrom fluid_sim_ros.cli.main import main\n'
        f'from fluid_sim_ros.recording.model import trial\n{ACTIONS[action]}\n'
        f'print("heavy", *(name for name in {HEAVY} if name in sys.modules))\n'
    )
    done = subprocess.run(
        [sys.executable, '-c', script, str(log), str(tmp_path / 'out')],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == 'heavy'


def test_memory_of_a_trial(log, tmp_path, monkeypatch):
    """Its model may take ``model_bytes`` more: together below 256 MiB."""
    monkeypatch.setattr(trial, 'subprocess', subprocess)  # put back at the end
    trials = Trials(tmp_path)
    trial.try_model(log)
    assert 40 << 20 < trials.peak < MOST_OF_A_TRIAL
    # a second one is spared, until the file is another
    monkeypatch.setattr(trial, 'sys', SimpleNamespace(executable='/bin/false'))
    trial.try_model(log)
    os.utime(log, ns=(1, 1))
    with pytest.raises(LogError, match='the trial ended with code 1'):
        trial.try_model(log)
