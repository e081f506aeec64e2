# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import re
from pathlib import Path

import pytest

from test.support.paths import ROOT
from test.support.project_files import project_files

# Home folders and places of one machine; ROS topics and system folders are not among them.
MACHINE_PATH = re.compile(r'(?<![\w.$}*-])/(?:home|root|work|Users|mnt|workspace|builds)/[\w.]')
REGISTRY = re.compile(
    r'pypi\.(?:org|python)|python(?:hosted)\.org|(?:extra-)?index-url|find-links'
)


def faults(text):
    """Return what ties a text to one machine."""
    return MACHINE_PATH.findall(text) + REGISTRY.findall(text)


def test_no_file_names_a_place_of_one_machine():
    found, read = {}, 0
    for path in project_files():
        try:
            text = path.read_text(encoding='utf-8')
        except UnicodeDecodeError:  # a picture
            continue
        read += 1
        if path != Path(__file__).resolve() and faults(text):
            found[str(path.relative_to(ROOT))] = faults(text)
    assert found == {}
    assert read > 50


@pytest.mark.parametrize(
    'text',
    [
        'see /ho' + 'me/ann/project',
        "open('/ro" + "ot/x')",
        'pip install --index' + '-url x',
        'https://py' + 'pi.org/simple',
    ],
)
def test_such_a_place_is_found(text):
    assert faults(text)


@pytest.mark.parametrize(
    'text', ['/opt/ros/jazzy', '~/reset', 'a/wo' + 'rk/b', '/clock', '/dev/shm']
)
def test_other_paths_pass(text):
    assert not faults(text)
