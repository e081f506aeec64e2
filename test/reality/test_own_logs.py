# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A step takes the control of its begin: a log of ours, flown again in windows, is at rounding."""

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.flights.mapping import FlightMap, default_mapping
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.resources import models_folder
from test.support.flown import write_x500

HORIZONS = (0.1, 0.5)
#: Commands at times that are and are not those of a state that is logged.
MANOEUVRES = {
    'x500': ('hover', [
        (0.0, [5.2, 5.2, 5.25, 5.25]), (0.5, [5.5, 5.45, 5.45, 5.6]),
        (0.802, [5.0, 5.1, 5.1, 4.9]), (1.5, [5.2, 5.2, 5.2, 5.0]),
    ]),
    'bluerov2_heavy': (None, [
        (0.0, [9, 8, -9, -12, -4, -5, 4, 3]), (0.494, [-9, 2, 5, 10, 12, 5, -4, 6]),
        (1.2, [20, -20, 5, 5, 5, 5, 5, 5]),
    ]),
}  # fmt: skip


def record(folder, model, *more):
    """Return the log of a scene of ours whose schedule commands its thrusters."""
    keyframe, commands = MANOEUVRES[model]
    lines = [f'model: {models_folder() / model}.xml', f'vehicles: {{{model}: {model}}}']
    lines += [f'keyframe: {keyframe}'] if keyframe else []
    lines += ['duration: 2.0', 'schedule:']
    lines += [f'  - {{at: {at}, thrust: {{{model}: {thrusts}}}}}' for at, thrusts in commands]
    scene = folder / f'{model}.yaml'
    scene.write_text('\n'.join(lines) + '\n')
    assert main(['run', str(scene), '--record', str(folder / 'log.mcap'), *more]) == 0
    return next(folder.rglob('*.mcap'))


def errors_of(found):
    return [found.errors[name].max() for name in ('position_m', 'velocity_m_s', 'attitude_deg')]


@pytest.mark.parametrize('model', list(MANOEUVRES))
def test_the_log_of_our_own_run_is_repeated_to_rounding(tmp_path, model):
    flow = ['--current', '0.3', '0.1', '0'] if model == 'bluerov2_heavy' else []
    flight = read_flight(record(tmp_path, model, *flow))

    # the current of the scene comes up in .32 s; within a window its middle holds
    found = compare(flight, model, part=Part(0.35, horizons=HORIZONS))

    assert flight.raw.format == 'fluid_sim'
    assert found.numbers['driven_by'] == 'thrust'
    assert found.numbers['windows']['used'] > 20
    assert max(errors_of(found)) < 1e-11
    # and it is a test: without the fluid the same windows are far off
    rigid = found.baselines['rigid_body']['position_m'][:, -1]
    assert np.median(rigid) > 1e-4


def test_measured_speeds_at_the_full_rate_are_taken_at_the_begin_of_a_step(tmp_path):
    path = write_x500(tmp_path / 'x500.csv', seconds=2.0, every=1)

    found = compare(read_flight(path), 'x500', part=Part(horizons=HORIZONS))

    assert found.numbers['driven_by'] == 'rotor_speed'
    assert max(errors_of(found)) < 1e-9


def test_a_fit_to_our_own_log_begins_at_rounding(tmp_path):
    flight = read_flight(record(tmp_path, 'x500'))

    found = fit([flight], Task('x500', ('thrust_coefficient', 'rotor_drag')))

    assert found.rms[0] < 1e-8
    assert found.values == pytest.approx([p.value for p in found.parameters], rel=1e-6)


def test_commands_of_topics_and_of_a_schedule_are_one_signal(tmp_path):
    flight = read_flight(record(tmp_path, 'x500', '--hold'))

    signal = flight.signals['thrust']

    assert signal.command
    assert len(signal.times) > 150  # those of the controller
    assert np.isin([0.5, 0.802, 1.5], signal.times).all()
    assert signal.gaps == ()


def test_a_command_that_is_not_repeated_is_said(tmp_path):
    from fluid_sim_ros.flights.flight import Stream
    from fluid_sim_ros.flights.own_log import with_schedule

    once = Stream(np.zeros(3), {'x': np.zeros(3)})
    streams, faults = with_schedule(
        {'/rov/cmd/wrench': once, '/x/odom': once}, {'scene': {'schedule': []}}
    )

    assert set(streams) == {'/rov/cmd/wrench', '/x/odom'}
    assert faults == ('/rov/cmd/wrench: 3 commands that a comparison does not repeat',)


def test_a_measured_speed_is_no_command():
    from fluid_sim_ros.errors import ConfigError
    from fluid_sim_ros.schema.base import parse

    content = default_mapping('table').model_dump()
    content['signals'] = {
        'rotor_speed': {'stream': 'table', 'columns': ['a', 'b'], 'command': True}
    }

    with pytest.raises(ConfigError, match='command: only for thrust, normalized or pulse'):
        parse(FlightMap, content, 'mapping.yaml')
