"""The plugin tests share the benchmarks' model builder (benchmarks/plugin_common.py)."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / 'benchmarks'))


@pytest.fixture(autouse=True)
def _log_of_warnings_elsewhere(tmp_path, monkeypatch):
    """MuJoCo writes MUJOCO_LOG.TXT into the working directory."""
    monkeypatch.chdir(tmp_path)
