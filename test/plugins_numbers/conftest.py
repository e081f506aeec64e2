"""These tests run a small part of the benchmarks, with the benchmarks' own functions."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / 'benchmarks'))


@pytest.fixture(autouse=True)
def _warnings_go_elsewhere(tmp_path, monkeypatch):
    """MuJoCo appends its warnings of diverging runs to a file in the current folder."""
    monkeypatch.chdir(tmp_path)
