# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Fixtures of the tests of hostile logs."""

import os

import pytest

from test.support.log_models import body_model
from test.support.model_places import tetrahedron
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def body_flight(tmp_path_factory):
    """Return the log of a short flight of a model without files."""
    folder = tmp_path_factory.mktemp('flight')
    (folder / 'm.xml').write_bytes(body_model())
    record_flight(folder / 'a.mcap', folder / 'm.xml', seconds=0.1, piloted=False)
    return folder / 'a.mcap'


@pytest.fixture
def host_files(tmp_path):
    """Return a folder of the host with files of all kinds, and a pipe, that are nobody's."""
    folder = tmp_path / 'host'
    folder.mkdir()
    for name in ('x.obj', 'x.stl', 'x.msh', 'x.skn', 'x.png', 'x.ktx', 'x.txt'):
        (folder / name).write_text(tetrahedron(1))
    (folder / 'x.xml').write_bytes(body_model())
    os.mkfifo(folder / 'pipe')
    return folder
