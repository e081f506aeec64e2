# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import json
import signal
import subprocess
import sys

import pytest

from fluid_sim_ros import Simulation, cli, scene_names
from fluid_sim_ros.cli.main import INTERRUPTED
from fluid_sim_ros.resources import config_folder


def result_of(capsys, *arguments):
    """Run a command that succeeds; return what it wrote as JSON to standard output."""
    assert cli.main([*arguments, '--json', '-']) == 0
    return json.loads(capsys.readouterr().out)


def error_of(capsys, *arguments):
    """Run a command that fails; return exit code and error lines."""
    code = cli.main(list(arguments))
    captured = capsys.readouterr()
    assert captured.out == ''
    return code, captured.err.strip().splitlines()


def test_run_returns_the_state_of_the_same_simulation(capsys):
    result = result_of(capsys, 'run', 'rov', '--duration', '0.5', '--current', '.3', '0', '-.1')

    simulation = Simulation('rov')
    simulation.set_current([0.3, 0, -0.1])
    simulation.step(round(0.5 / simulation.timestep))
    state = simulation.snapshot().vehicles['bluerov2_heavy']
    vehicle = result['vehicles']['bluerov2_heavy']
    assert vehicle['position_w_m'] == state.position_w.tolist()
    assert vehicle['quat_wb_wxyz'] == state.quat_wb_wxyz.tolist()
    assert vehicle['velocity_b_m_s'] == state.velocity_b.tolist()
    assert vehicle['omega_b_rad_s'] == state.omega_b.tolist()
    assert result['duration_s'] == 0.5
    assert result['real_time_factor'] == pytest.approx(0.5 / result['wall_s'])


def test_run_finds_the_largest_force(capsys):
    # a sphere that sinks from rest gains speed all the time: the last force is the largest
    result = result_of(capsys, 'run', 'sphere', '--duration', '1')
    vehicle = result['vehicles']['sphere']

    simulation = Simulation('sphere')
    simulation.step(round(1 / simulation.timestep))
    force = sum(force for force, _ in simulation.wrench('sphere').values())
    assert vehicle['largest_fluid_force_at_s'] == 1
    assert vehicle['largest_fluid_force_n'] == pytest.approx((force @ force) ** 0.5, rel=1e-12)


def test_run_takes_the_options_of_the_simulation(capsys):
    result = result_of(
        capsys, 'run', 'sphere', '--duration', '.1', '--timestep', '.0025', '--integrator', 'rk4',
        '--fluid', 'none', '--seed', '3',
    )  # fmt: skip
    assert (result['timestep_s'], result['integrator'], result['seed']) == (0.0025, 'rk4', 3)
    assert result['steps'] == 40
    assert result['vehicles']['sphere']['largest_fluid_force_n'] == 0


def test_run_in_real_time_keeps_pace(capsys):
    result = result_of(capsys, 'run', 'sphere', '--duration', '.3', '--pacing', 'realtime')
    # the last 10 ms of steps need no waiting
    assert result['wall_s'] > 0.28


def test_run_shows_a_table(capsys):
    assert cli.main(['run', 'sphere', '--duration', '0.1']) == 0
    shown = capsys.readouterr().out
    assert 'real-time factor' in shown
    assert 'position [m]' in shown


def test_run_writes_a_file_and_shows_the_table_too(capsys, tmp_path):
    path = tmp_path / 'result.json'
    assert cli.main(['run', 'sphere', '--duration', '0.1', '--json', str(path)]) == 0
    assert json.loads(path.read_text())['scene'] == 'sphere'
    assert 'real-time factor' in capsys.readouterr().out


def test_scenes_lists_every_scene_and_describes_those_with_a_file(capsys):
    rows = result_of(capsys, 'scenes')
    assert [row['name'] for row in rows] == scene_names()
    described = {row['name'] for row in rows if row['description']}
    assert described == {path.stem for path in (config_folder() / 'scenes').glob('*.yaml')}


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        (['run', 'submarine'], "scene 'submarine' is not known; scenes: "),
        (['run', 'sphere', '--wind', '1', '0', '0'], 'the scene is in water only'),
        (['run', 'rov', '--current', 'nan', '0', '0'], 'current'),
        (['run', 'rov', '--duration', '-1'], 'duration -1 s: must be finite and above 0'),
        (['run', 'rov', '--duration', 'nan'], 'duration nan s: must be finite and above 0'),
        (['run', 'rov', '--timestep', '0'], '--timestep: must be greater than 0 (got 0.0)'),
        (['run', 'rov', '--integrator', 'leapfrog'], "--integrator: 'leapfrog' is not known"),
        (['run', 'rov', '--fluid', 'honey'], "--fluid: 'honey' is not known"),
        (['run', 'no/such/file.xml'], 'no/such/file.xml: no such MJCF file'),
        (['scenes', '--json', 'no/such/folder/x.json'], 'cannot be written'),
    ],
)
def test_wrong_input_is_one_line_and_exit_code_2(capsys, arguments, message):
    code, lines = error_of(capsys, *arguments)
    assert code == 2
    assert len(lines) == 1
    assert lines[0].startswith('fluid_sim: ')
    assert message in lines[0]


@pytest.mark.parametrize(
    'arguments',
    [
        [],
        ['fly'],
        ['run'],
        ['run', 'rov', '--dur', '1'],
        ['run', 'rov', '--pacing', 'lockstep'],
        ['run', 'rov', '--current', '1', '2'],
        ['run', 'rov', '--seed', '1.5'],
        ['doctor', 'rov', 'now'],
    ],
)
def test_wrong_usage_is_one_line_and_exit_code_2(capsys, arguments):
    with pytest.raises(SystemExit) as exit_info:
        cli.main(arguments)
    assert exit_info.value.code == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1
    assert '--help' in lines[0]


def test_a_diverging_run_is_one_line_and_exit_code_1(capsys, tmp_path):
    # a light plate thrown edge-on through water: explicit Euler overshoots at this timestep
    path = tmp_path / 'plate.xml'
    path.write_text("""
      <mujoco>
        <option timestep="0.1" integrator="Euler" density="1000" gravity="0 0 0"/>
        <worldbody>
          <body name="plate"><freejoint/>
            <geom type="ellipsoid" size=".1 .1 .002" density="50" fluidshape="ellipsoid"/>
          </body>
        </worldbody>
        <keyframe><key name="thrown" qpos="0 0 0 1 0 0 0" qvel="1 1 9 5 5 5"/></keyframe>
      </mujoco>""")
    scene = tmp_path / 'thrown.yaml'
    scene.write_text('model: plate.xml\nkeyframe: thrown\nduration: 10.0\n')

    code, lines = error_of(capsys, 'run', str(scene))

    assert code == 1
    assert len(lines) == 1
    assert 'diverged at t = ' in lines[0]
    assert "body 'plate'" in lines[0]


def test_help_loads_no_physics():
    script = (
        'import sys\n'
        'from fluid_sim_ros import cli\n'
        'try:\n    cli.main(["run", "--help"])\n'
        'except SystemExit:\n    pass\n'
        'heavy = {"mujoco", "numpy", "rclpy", "pydantic"} & set(sys.modules)\n'
        'sys.exit(f"loaded: {heavy}" if heavy else 0)\n'
    )
    done = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert 'SCENE' in done.stdout


def test_an_interrupted_run_is_one_line(capsys):
    # as Ctrl-C would, some steps into a run of 8 s
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    try:
        code, lines = error_of(capsys, 'run', 'sphere', '--pacing', 'realtime')
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    assert code == INTERRUPTED == 130
    assert lines[-1] == 'fluid_sim: interrupted'
