# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Advised settings go into a scene's file, and nothing else in it changes."""

import difflib
from pathlib import Path

import pytest
import yaml

from fluid_sim_ros import Scene
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor import scene_settings
from fluid_sim_ros.lab.advisor.scene_settings import apply, changed_text, keep

SCENES = sorted((Path(__file__).resolve().parents[2] / 'config/scenes').glob('*.yaml'))
COMMENT = 'fluid_sim advise mine --tolerance 0.01: error 0.004 (pose)'
CHOICE = {'timestep': 1e-05, 'integrator': 'RK4'}
ADVISED = {
    'command': 'fluid_sim advise a: b.yaml --tolerance 0.01', 'tolerance': 0.01,
    'metric': 'pose', 'error': 0.0, 'timestep': 2e-05, 'integrator': 'Euler', 'fluid': 'none',
}  # fmt: skip

PLAIN = """\
# a scene of mine

model: sphere   # the model
medium: water
vehicles: {sphere:   sphere}
duration: 2.0  # [s]
keyframe: drop
"""
#: Text of a scene file, by what is odd about it.
ODD = {
    'plain': PLAIN,
    'settings': PLAIN + 'timestep: 0.002   # mine\nintegrator: Euler\nfluid: none\n',
    'comments': PLAIN
    + '  # indented\ntimestep: 0.002\n# of the fluid\nfluid: none  # nothing\n'
    '# the end\n\n# it is\n',
    'flow': "{model: sphere, medium: water, vehicles: {sphere: sphere}, duration: 2.0,\n"
    ' keyframe: drop, timestep: 0.002}\n',
    'anchors': PLAIN.replace('duration: 2.0', 'duration: &two 2.0')
    + 'timestep: &h 0.002\nschedule:\n- {at: *two, current: [*h, 0, 0]}\n',
    'alias': PLAIN.replace('2.0', '&h 0.5') + 'timestep: *h\n',
    'quoted': PLAIN.replace('medium:', '"medium":')
    + '"timestep": "0.002"\n\'integrator\': \'Euler\'\n',
    'CRLF': (PLAIN + 'timestep: 0.002\n').replace('\n', '\r\n'),
    'no newline': PLAIN + 'timestep: 0.002',
    'comment at the end': PLAIN + 'timestep: 0.002\n# no newline',
    'document marks': '---\n' + PLAIN + 'timestep: 0.002\n...\n',
    'long lines': PLAIN
    + 'description: >-\n  about ' + 'a sphere ' * 30 + '\n  and more\nschedule:\n'
    '    - {at: 0.5,\n       current: [0, 0,\n                 0]}\n    - at: 1.0\n'
    '      current:\n'
    '        - 0.1\n        - 0\n        - 0\n',
    'advised': PLAIN + 'advised: {command: c, tolerance: 0.1, metric: pose, error: 0.05,\n'
    '  timestep: 0.01, integrator: RK4}\n',
}  # fmt: skip


def scene_of(tmp_path, text: str) -> str:
    path = tmp_path / 'mine.yaml'
    path.write_bytes(text.encode())
    return str(path)


@pytest.mark.parametrize('name', ODD)
def test_apply_puts_settings_in_force_in_an_odd_file(name, tmp_path):
    path = scene_of(tmp_path, ODD[name])
    before = Scene.load(path)
    apply(path, CHOICE, COMMENT)
    loaded = Scene.load(path)
    assert (loaded.timestep, loaded.integrator, loaded.fluid) == (1e-05, 'RK4', None)
    for key in ('model_path', 'duration', 'schedule', 'description', 'keyframe', 'advised'):
        assert getattr(loaded, key) == getattr(before, key)
    text = Path(path).read_bytes().decode()
    assert text.count(f'# {COMMENT}') == 1
    # once more: the same text, not a comment more
    apply(path, {**CHOICE, 'fluid': 'none'}, COMMENT.replace('0.004', '0.003'))
    apply(path, CHOICE, COMMENT)
    assert Path(path).read_bytes().decode() == text


@pytest.mark.parametrize('name', ODD)
def test_keep_stands_beside_the_settings_of_an_odd_file(name, tmp_path):
    path = scene_of(tmp_path, ODD[name])
    before = Scene.load(path)
    for _ in range(2):
        keep(path, ADVISED)
    loaded = Scene.load(path)
    assert loaded.advised.model_dump() == ADVISED
    for key in ('model_path', 'duration', 'schedule', 'description', 'timestep', 'fluid'):
        assert getattr(loaded, key) == getattr(before, key)


@pytest.mark.parametrize('name', ODD)
def test_comments_and_formatting_stay(name, tmp_path):
    """Every line that says nothing of the settings is there as it was, to the byte."""
    path = scene_of(tmp_path, ODD[name])
    apply(path, CHOICE, COMMENT)
    keep(path, ADVISED)
    after = Path(path).read_bytes().decode().splitlines(keepends=True)
    kept = [
        line
        for line in ODD[name].splitlines(keepends=True)
        if not any(
            word in line for word in ('timestep', 'integrator', 'fluid: none', 'advised', '*h,')
        )
    ]
    left = iter(after)
    if name == 'flow':  # all keys in one value: written anew, on one line
        return
    for line in kept:
        assert any(line.rstrip('\r\n') == other.rstrip('\r\n') for other in left), line
    ends = {line[len(line.rstrip('\r\n')) :] for line in after}
    assert ends == {'\r\n' if name == 'CRLF' else '\n'}


@pytest.mark.parametrize('path', SCENES, ids=lambda path: path.stem)
def test_a_shipped_scene_changes_by_the_settings_alone(path):
    text = path.read_text(encoding='utf-8')
    after = changed_text(text, CHOICE, COMMENT)
    changed = [
        line
        for line in difflib.unified_diff(text.splitlines(), after.splitlines(), lineterm='', n=0)
        if line[0] in '+-' and line[:3] not in ('+++', '---')
    ]
    words = ('timestep:', 'integrator:', f'# {COMMENT}')
    assert all(line[1:].startswith(words) for line in changed)
    assert yaml.safe_load(after) == yaml.safe_load(text) | CHOICE


def test_a_setting_that_is_taken_out_leaves_the_comments_around_it():
    text = 'a: 1\n# of fluid\nfluid: none  # its own\n# of b\nb: 2\n\n# end\n'
    assert changed_text(text, {'fluid': None}) == 'a: 1\n# of fluid\n# of b\nb: 2\n\n# end\n'


def test_a_file_that_cannot_hold_them_stays_as_it_was(tmp_path, monkeypatch):
    path = scene_of(tmp_path, PLAIN)
    with pytest.raises(ConfigError, match=r'write them by hand: \{advised: \{.*integrator: RK7'):
        keep(path, {**ADVISED, 'integrator': 'RK7'})
    assert Path(path).read_bytes().decode() == PLAIN
    # what is lost beside them is noticed, too
    monkeypatch.setattr(
        scene_settings, 'changed_text', lambda *_: 'model: sphere\ntimestep: 0.01\n'
    )
    with pytest.raises(ConfigError, match='could not be put in'):
        apply(path, {'timestep': 0.01}, COMMENT)
    assert Path(path).read_bytes().decode() == PLAIN


def test_a_file_that_is_no_yaml_is_one_line(tmp_path):
    path = scene_of(tmp_path, 'model: [sphere\n')
    with pytest.raises(ConfigError, match=r'mine\.yaml: cannot be read as YAML: [^\n]*$'):
        keep(path, ADVISED)
    assert Path(path).read_bytes() == b'model: [sphere\n'
