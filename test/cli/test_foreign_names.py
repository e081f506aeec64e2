# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Names of scenes, models and vehicles that others chose: no markup, no escapes, no formats."""

import pytest

from fluid_sim_ros.cli.main import WRONG_INPUT, main

MODEL = (
    '<mujoco><option density="1.2"/><worldbody><body name="{name}"><freejoint/>'
    '<geom name="g" size=".1" fluidshape="ellipsoid"/></body></worldbody></mujoco>'
)
NAMES = (
    '[bold red]x', '[/]', '[link=file:///etc/passwd]x', 'a\x1b[2Jb', 'x\u202egpj', '{0.__class__}',
    '{}', '{', '%s%n', "'", 'a\nb', 'x' * 200, '-x', '~',
)  # fmt: skip


def said(capsys):
    """Return what was shown; nothing in it may act on a terminal."""
    shown = capsys.readouterr()
    text = shown.out + shown.err
    assert text.replace('\n', '').isprintable()
    return text


@pytest.mark.parametrize('name', NAMES, ids=range(len(NAMES)))
@pytest.mark.parametrize('command', ['run', 'doctor'])
def test_a_file_with_an_odd_name(name, command, tmp_path, capsys):
    (tmp_path / 'm.xml').write_text(MODEL.format(name='b'))
    path = tmp_path / f'{name.replace("/", "")}.yaml'
    path.write_text('model: m.xml\n')
    more = ['--duration', '0.1'] if command == 'run' else []
    assert main([command, str(path), *more]) in (0, 1)
    said(capsys)
    path.write_text('model: m.xml\ntimestep: -1\n')
    assert main([command, str(path), *more]) in (1, WRONG_INPUT)
    assert 'timestep' in said(capsys)


@pytest.mark.parametrize('name', [n for n in NAMES if not set(n) & set('<&"\n\x1b')])
def test_a_body_with_an_odd_name(name, tmp_path, capsys):
    (tmp_path / 'm.xml').write_text(MODEL.format(name=name))
    assert main(['run', str(tmp_path / 'm.xml'), '--duration', '0.1']) in (0, 1, WRONG_INPUT)
    said(capsys)


@pytest.mark.parametrize('name', NAMES, ids=range(len(NAMES)))
def test_an_odd_key_of_a_scene(name, tmp_path, capsys):
    path = tmp_path / 'a.yaml'
    quoted = ''.join(f'\\u{ord(c):04x}' for c in name)
    for text in (
        f'model: sphere\n"{quoted}": 1\n',
        f'model: "{quoted}"\n',
        f'model: sphere\nwind: [{{model: "{quoted}"}}]\n',
        f'model: sphere\nvehicles: {{sphere: "{quoted}"}}\n',
        f'model: sphere\nkeyframe: "{quoted}"\n',
        f'model: sphere\nfluid: "{quoted}"\n',
    ):
        path.write_text(text)
        assert main(['run', str(path)]) == WRONG_INPUT
        assert said(capsys).count('\n') == 1
