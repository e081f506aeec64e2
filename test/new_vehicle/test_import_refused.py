# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim import``: files and answers that cannot be: one line each, with the remedy."""

import pytest
import yaml

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.new_vehicle.importing.answers import answers_of
from fluid_sim_ros.new_vehicle.importing.writing import write_imported
from test.support.imported import SCREW, refusal, rov, vehicle

pytest.importorskip('capytaine')


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        ({'mass': 0}, "link 'base': mass 0: must be above 0 [kg]"),
        ({'mass': -1}, "link 'base': mass -1"),
        ({'mass': 'x'}, "mass value: must be a finite number (got 'x')"),
        ({'ixx': 1.0}, 'no body has the principal moments of inertia 0.3 0.4 1'),
        ({'ixx': 0.0}, 'must be above 0 [kg m^2]'),
        ({'mass': 1e6}, 'denser than any metal'),
        ({'geometry': '<geometry><sphere radius="x"/></geometry>'}, 'MuJoCo does not read it'),
        ({'more': '<link name="loose"/>'}, 'must have one root link; it has: base, loose'),
    ],
)
def test_a_urdf_that_cannot_be_is_refused_in_one_line(tmp_path, change, words):
    assert words in refusal(rov(tmp_path, **change))


@pytest.mark.parametrize(
    ('options', 'words'),
    [
        ({'thrusters': [{'link': 'scrw', 'max_thrust': 1}]}, "did you mean 'screw'?"),
        ({'thrusters': [{'max_thrust': 1}]}, 'give link, or name and position'),
        ({'thrusters': [SCREW, SCREW]}, "the name 'screw' stands twice"),
        ({'fixed': ['elbow']}, "fixed 'elbow' is not in the file; it has: (none)"),
        ({'mass': -1.0}, 'mass -1: must be above 0 [kg]'),
        ({'mass': 3.0, 'body_density': 900.0}, 'give one of them'),
        ({'inertia': [1.0, 1.0, 3.0]}, 'the two smaller moments together are 2, the largest is 3'),
        ({'unit': 'yd'}, '--unit'),
        ({'hull': 'none.stl'}, 'none.stl: no such file'),
        ({'buoyancy': '-400'}, 'must be above -294'),
        ({'sensors': ['radar']}, '--sensors'),
        ({'thrusters': 'quad', 'fixed': ['shaft']}, '--thrusters quad: is for air; for water'),
    ],
)  # fmt: skip
def test_answers_that_cannot_be_are_refused_in_one_line(tmp_path, options, words):
    assert words in refusal(rov(tmp_path), **options)


def test_answers_name_their_file_and_key(tmp_path):
    path = tmp_path / 'answers.yaml'
    path.write_text(yaml.safe_dump({'medium': 'sea'}))
    with pytest.raises(ConfigError, match=r"answers.yaml: key 'medium'"):
        answers_of(path, {})
    path.write_text(yaml.safe_dump({'thruster': []}))
    with pytest.raises(ConfigError, match="did you mean 'thrusters'"):
        answers_of(path, {})


def test_files_that_are_none(tmp_path):
    assert 'no such file' in refusal(tmp_path / 'none.urdf')
    for text, words in (
        ('<robot', 'is no XML'),
        ('<a/>', 'is neither <robot> (URDF) nor <mujoco> (MJCF)'),
        ('<!DOCTYPE a [<!ENTITY b "c">]><robot name="&b;"/>', 'declares entities'),
        ('<robot name="a"/>', 'must have one root link'),
    ):
        (tmp_path / 'a.urdf').write_text(text)
        assert words in refusal(tmp_path / 'a.urdf')
    assert "'.step' is not imported; allowed" in refusal(tmp_path / 'a.step')
    made = vehicle(rov(tmp_path))
    write_imported(made, tmp_path / 'out')
    with pytest.raises(ConfigError, match='exists; give another --out'):
        write_imported(made, tmp_path / 'out')


def test_a_mass_of_zero_is_refused_and_not_taken_as_left_out(tmp_path):
    for name, words in (('mass', 'mass 0: must be above 0'), ('body_density', 'greater than 0')):
        with pytest.raises(ConfigError, match=words):
            answers_of(None, {name: 0.0})
