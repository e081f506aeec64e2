# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A fit finds what a flight was flown with, with errors that hold, and says what it cannot."""

import json

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting.normal import sandwich
from fluid_sim_ros.reality.fitting.shooting import Linear
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import all_parameters, find_parameters
from test.support.flown import write_x500

NOISE = {'position': 0.002, 'attitude': 0.001, 'velocity': 0.01, 'rates': 0.005}
NAMES = ('thrust_coefficient', 'rotor_drag', 'inertia.x')
#: Where the fits begin: up to a half off.
WRONG = {'thrust_coefficient': 8e-6, 'rotor_drag': 4e-5, 'inertia.x': 0.03}


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    return write_x500(tmp_path_factory.mktemp('flown') / 'x500.csv', seconds=5.0, every=1)


@pytest.fixture(scope='module')
def noisy(tmp_path_factory):
    return write_x500(
        tmp_path_factory.mktemp('flown') / 'x500.csv', seconds=5.0, every=1, noise=NOISE
    )


def test_without_noise_the_truth_is_found(log):
    found = fit([read_flight(log)], Task('x500', NAMES, values=WRONG))

    for parameter, value in zip(found.parameters, found.values, strict=True):
        assert value == pytest.approx(parameter.value, rel=0.01), parameter.name
    assert found.rms[1] < 0.1 * found.rms[0]


def test_with_noise_the_truth_is_within_three_errors(noisy):
    found = fit([read_flight(noisy)], Task('x500', NAMES, values=WRONG))

    for parameter, value, error in zip(found.parameters, found.values, found.errors, strict=True):
        assert abs(value - parameter.value) < 3 * error, parameter.name
        assert 0 < error < 0.2 * parameter.value
    # the noise is found too, by itself
    assert found.sigmas == pytest.approx([0.002, 0.002, 0.01, 0.005], rel=0.2)
    assert found.rms[1] == pytest.approx(1.0, abs=0.1)


def test_few_windows_are_said_with_what_their_errors_mean(noisy):
    found = fit([read_flight(noisy)], Task('x500', ('rotor_drag',)))

    assert found.windows == 9
    assert any(
        line.startswith(
            '9 windows: standard errors are themselves known to 25 %; 95 % of fits lie'
        )
        and 'within 2.31 of them' in line
        for line in found.lines
    )


def test_errors_are_those_of_a_jackknife_by_windows():
    rng = np.random.default_rng(1)
    jp = rng.normal(size=(6, 5, 2))
    residual = rng.normal(size=(6, 5))
    whole = np.linalg.lstsq(jp.reshape(-1, 2), residual.ravel(), rcond=None)[0]
    linear = Linear(residual - jp @ whole, jp, np.zeros((6, 5, 1)))  # at the least squares
    curved, scatter, number = sandwich([linear], np.ones(2), np.zeros((2, 2)))
    covariance = np.linalg.inv(curved) @ scatter @ np.linalg.inv(curved)
    left = []
    for i in range(6):
        rest = np.arange(6) != i
        left.append(np.linalg.lstsq(
            jp[rest].reshape(-1, 2), residual[rest].ravel(), rcond=None
        )[0] - whole)  # fmt: skip
    assert number == 6
    assert covariance == pytest.approx(5 / 6 * np.array(left).T @ np.array(left), rel=1e-6)


def test_mass_and_thrust_are_not_told_apart(log):
    found = fit([read_flight(log)], Task('x500', ('thrust_coefficient', 'mass', 'inertia.xy',
                                                  'inertia.z', 'rotor_drag')))  # fmt: skip

    assert any('are not told apart' in line and 'weigh' in line for line in found.lines)


def test_what_a_flight_does_not_touch_is_named(log):
    found = fit([read_flight(log)], Task('x500', ('thrust_coefficient', 'time_constant')))

    # measured speeds drive the model: there is no lag to see
    assert any(
        line.startswith('time_constant: the flights do not touch it') for line in found.lines
    )
    assert found.values[0] == pytest.approx(8.54858e-6, rel=0.01)


def test_the_command_patches_applies_and_goes_on(log, tmp_path):
    model, patch = tmp_path / 'fitted.xml', tmp_path / 'patch.yaml'
    kept = tmp_path / 'kept.json'
    kept.write_text(json.dumps(WRONG))

    code = main([
        'fit', str(log), '--model', 'x500', '--parameters', *NAMES, '--test', str(log),
        '--resume', str(kept), '--patch', str(patch), '--apply', str(model),
        '--json', str(tmp_path / 'fit.json'),
    ])  # fmt: skip

    assert code == 0
    result = json.loads((tmp_path / 'fit.json').read_text())
    assert result['parameters']['rotor_drag']['value'] == pytest.approx(8.06428e-5, rel=0.01)
    assert set(result['test']['x500.csv']) >= {'before', 'after', 'baselines'}
    assert json.loads(kept.read_text())['inertia.x'] == pytest.approx(0.0238384, rel=0.01)
    assert 'fitted by fluid_sim fit to x500.csv' in patch.read_text()
    assert 'rotor_drag: 8.0' in patch.read_text()
    load_plugins()
    applied = mujoco.MjModel.from_xml_path(str(model))
    assert applied.body('x500').inertia[0] == pytest.approx(0.0238384, rel=0.01)
    assert 'inertia.x: 0.0238' in model.read_text()


def test_an_unknown_parameter_is_one_line():
    with pytest.raises(ConfigError, match=r"not one of x500; did you mean 'rotor_"):
        find_parameters(comparable_scene('x500'), ['rotor_darg'])


def test_no_parameters_lists_those_of_the_model(log, capsys):
    assert main(['fit', str(log), '--model', 'bluerov2_heavy']) == 0

    text = capsys.readouterr().out
    assert 'added_mass.heave: 18.68 kg' in text
    assert 'center_of_buoyancy.z: 0.01 m' in text


@pytest.mark.parametrize('scene', ['x500', 'bluerov2_heavy', 'crazyflie'])
def test_every_parameter_changes_the_model_that_it_is_of(scene):
    scene = comparable_scene(scene)
    for parameter in all_parameters(scene):
        value = parameter.value + 0.01 * parameter.scale

        model = scene.compile(edit=lambda spec, p=parameter, v=value: p.put(spec, v)).model

        assert np.isfinite(model.body_mass).all(), parameter.name


def test_a_file_that_holds_no_values_is_refused(log, tmp_path):
    kept = tmp_path / 'kept.json'
    kept.write_text('[1, 2]')

    code = main(
        ['fit', str(log), '--model', 'x500', '--parameters', 'mass', '--resume', str(kept)]
    )

    assert code == 2
