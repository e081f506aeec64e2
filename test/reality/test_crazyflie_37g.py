# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The model that was fitted to real flights, and what a fit of it needs."""

import pytest

from benchmarks.reality import crazyflie_37g, crazyflie_limits
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import all_parameters, edit_of
from fluid_sim_ros.schema.settings import RunSettings
from test.support.flown import write_x500


def test_the_benchmark_says_so_without_the_recordings(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr('sys.argv', ['crazyflie_37g', '--flights', str(tmp_path)])

    with pytest.raises(SystemExit) as ended:
        crazyflie_37g.main()

    assert ended.value.code == 0
    assert 'not part of this repository; --flights FOLDER' in capsys.readouterr().out


def test_the_recordings_are_predicted_as_the_page_says():
    path = crazyflie_37g.FLIGHTS / 'crazyflie_figure8_26.usd'
    if not path.exists():
        pytest.skip('the recordings are not here')

    found = crazyflie_37g.errors_of(read_flight(path))

    here, literature = (found[m]['horizons']['0.5'] for m in ('crazyflie_37g', 'crazyflie'))
    assert here['position_m'] < 0.08
    assert here['attitude_deg'] < 13
    assert all(literature[key] > 3 * here[key] for key in here)
    assert found['crazyflie_37g']['z_rms_of_g'] < 0.02


def test_entries_of_a_damping_matrix_are_parameters():
    scene = comparable_scene('crazyflie_37g')
    known = {p.name: p for p in all_parameters(scene)}

    assert known['linear_damping.roll_sway'].value == pytest.approx(-4.89e-4)
    assert known['linear_damping.pitch_surge'].unit == 'N s'
    assert known['linear_damping.surge'].low == 0
    assert 'linear_damping.yaw_heave' not in known


def test_the_refitted_model_has_a_moment_that_fades(tmp_path):
    path = crazyflie_limits.write_refitted(tmp_path / 'refitted.xml')

    known = {p.name: p for p in all_parameters(comparable_scene(path))}

    assert known['moment_fade.pitch'].value == crazyflie_limits.FADE
    assert 'moment_fade.roll' not in known
    for name, value in crazyflie_limits.REFITTED.items():
        assert known[name].value == pytest.approx(value)


@pytest.mark.parametrize('name', ['crazyflie_37g', 'bluerov2_heavy'])
def test_parameters_of_the_fluid_do_nothing_without_one(name):
    scene = comparable_scene(name)
    chosen = [p for p in all_parameters(scene) if 'damping' in p.name]

    model = scene.compile(RunSettings(fluid='none'), edit_of(chosen, [p.value for p in chosen]))

    assert len(chosen) > 5
    assert model.model.nbody > 1


def test_windows_that_start_as_measured_find_the_truth_without_noise(tmp_path):
    path = write_x500(tmp_path / 'x500.csv', seconds=4.0, every=1)
    wrong = {'thrust_coefficient': 8e-6, 'rotor_drag': 4e-5}

    found = fit([read_flight(path)], Task('x500', tuple(wrong), values=wrong, start='measured'))

    assert found.values == pytest.approx([p.value for p in found.parameters], rel=0.01)
