import pytest


@pytest.fixture(autouse=True)
def _log_of_warnings_elsewhere(tmp_path, monkeypatch):
    """MuJoCo writes MUJOCO_LOG.TXT into the working directory."""
    monkeypatch.chdir(tmp_path)
