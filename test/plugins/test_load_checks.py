# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Everything that is refused or warned about when a model is loaded, each with one line."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins.messages import load_error_line
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, refusal, world

HULL = ellipsoid([0.3, 0.2, 0.1], 500)
SEA = {'density': 1000, 'viscosity': 1e-3}
#: Resistance with a moment of pitch by surge, row by row.
MOMENT = [1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0,
          0, 0, 0, 1, 0, 0, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]  # fmt: skip
EYE = [1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1]


def hull(**values):
    return free_body(HULL + body_plugin(**values))


def simple(**values):
    return hull(**values).replace('simple="false"', 'simple="auto"')


BAD_BODIES = {
    # case: (body, what the line must name)
    'wrong count': (hull(added_mass=[1, 2]), ['added_mass', "'1 2'", '6, 21 or 36', 'got 2']),
    'not a number': (hull(added_mass='1 2 3 4 five 6'), ['added_mass', 'five', '6, 21 or 36']),
    'infinite': (hull(added_mass='1 2 3 4 inf 6'), ['added_mass', 'inf', '6, 21 or 36']),
    'nan': (hull(linear_damping='1 2 3 4 nan 6'), ['linear_damping', 'nan', '6 or 36']),
    'negative added mass': (
        hull(added_mass=[1, 1, -1, 1, 1, 1]), ['added_mass', 'semi-definite', 'eigenvalue -1']
    ),
    'indefinite added mass': (
        hull(added_mass=[1, 2, *EYE[2:]]), ['added_mass', 'semi-definite', 'eigenvalue -1']
    ),
    'asymmetric added mass': (
        hull(added_mass=[1, 0.5, *[0] * 5, 1, *[0] * 28]), ['added_mass', 'symmetric']
    ),
    'negative linear damping': (
        hull(linear_damping=[1, 1, 1, 1, 1, -2]), ['linear_damping', 'semi-definite', '-2']
    ),
    'negative quadratic damping': (
        hull(quadratic_damping=[1, 1, 1, 1, 1, -2]), ['quadratic_damping', 'diagonal', '>= 0']
    ),
    'cross damping count': (hull(cross_damping='1 2 3'), ['cross_damping', '1 2 3', 'groups']),
    'cross damping index': (hull(cross_damping='1 2 7 1'), ['cross_damping', '1..6']),
    'total of nothing': (
        hull(added_mass='auto', cross_damping_total='true'), ['cross_damping_total', 'needs']
    ),
    'total of a square': (
        hull(cross_damping='5 1 1 2', cross_damping_total='true'), ['5 1 1 2', 'two different']
    ),
    'total twice': (
        hull(cross_damping='5 1 3 2 5 3 1 2', cross_damping_total='true'), ['once in a row']
    ),
    'negative fade': (
        hull(linear_damping=MOMENT, moment_fade='0 -1'), ['moment_fade', '-1', '>= 0']
    ),
    'fade of nothing': (
        hull(linear_damping=[1] * 6, moment_fade='0 1'), ['moment_fade needs linear_damping']
    ),
    'fade beside its mirror': (
        hull(linear_damping=[*MOMENT[:4], 0.1, *MOMENT[5:]], moment_fade='0 1'),
        ['moment_fade', 'would not fade'],
    ),
    'negative volume': (hull(volume=-3), ['volume', "'-3'", 'auto or a number > 0 [m^3]']),
    'zero volume': (hull(volume=0), ['volume', "'0'", '> 0']),
    'unknown word': (
        hull(drag='elipsoid'), ['drag', 'elipsoid', 'builtin, ellipsoid, inertia_box, none']
    ),
    'unknown area': (
        hull(drag='ellipsoid', drag_area='real'), ['drag_area', 'real', 'lemma, true']
    ),
    'unknown geom': (hull(volume='auto', geoms='keel'), ['geoms', 'keel', 'this body']),
    'option without drag': (
        hull(added_mass='auto', drag='none', drag_area='true'), ['drag_area', 'needs']
    ),
    'centre without volume': (
        hull(added_mass='auto', center_of_buoyancy=[0, 0, 1]), ['center_of_buoyancy', 'volume']
    ),
    'point without use': (hull(volume=1, reference_point=[0, 0, 1]), ['reference_point', 'needs']),
    'nothing on': (hull(drag='none'), ['nothing is switched on', 'added_mass', 'volume']),
    'simple body': (simple(added_mass='auto'), ['diagonal', 'simple="false"', "body 'hull'"]),
    'gravcomp and buoyancy': (
        hull(volume='auto').replace('simple', 'gravcomp="1" simple'),
        ['volume', 'gravcomp = 1', 'gravcomp="0"'],
    ),
    'auto without fluid geom': (
        hull(added_mass='auto').replace('fluidshape="ellipsoid"', ''),
        ['added_mass', 'auto', 'fluidshape="ellipsoid"'],
    ),
    'drag without fluid geom': (
        hull(drag='ellipsoid').replace('fluidshape="ellipsoid"', ''),
        ['drag', 'fluidshape="ellipsoid"'],
    ),
    'volume without geom': (
        free_body('<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
                  + body_plugin(volume='auto')),
        ['volume', 'auto needs a sphere'],
    ),
    'immovable': (
        hull(added_mass='auto').replace('<freejoint/>', ''), ['cannot move', 'remove']
    ),
}  # fmt: skip


def line_of(xml):
    return refusal(xml, 'fluid_sim.')


@pytest.mark.parametrize('case', BAD_BODIES)
def test_bad_body_is_refused_with_one_line(case):
    bodies, words = BAD_BODIES[case]
    line = line_of(world(bodies, medium=SEA))
    assert line.startswith("fluid_sim.body: body 'hull': ")
    for word in words:
        assert word in line


BAD_MEDIA = {
    'negative density': ({'density': -1}, ['density', "'-1'", '>= 0 [kg/m^3]']),
    'negative viscosity': ({'viscosity': -1}, ['viscosity', '>= 0', '[Pa s]']),
    'short current': ({'current': [1, 2]}, ['current', '3 numbers', 'got 2']),
    'negative slew': ({'wind_slew': -1}, ['wind_slew', '>= 0']),
    'surface word': ({'surface': 'high'}, ['surface', 'high', 'none or a height']),
    'air without surface': ({'density_above': 1.2}, ['density_above', 'surface']),
    'profile word': ({'wind_profile': 'jet 1 2'}, ['wind_profile', 'jet', 'uniform | power']),
    'profile order': ({'wind_profile': 'table 2 1 1 2'}, ['wind_profile', 'h rising']),
    'log profile': ({'wind_profile': 'log 3 2'}, ['wind_profile', 'ROUGHNESS < HEIGHT']),
    'bed missing': ({'current_profile': 'power 0.143 5'}, ['current_profile', 'current_datum']),
}


@pytest.mark.parametrize('case', BAD_MEDIA)
def test_bad_medium_is_refused_with_one_line(case):
    values, words = BAD_MEDIA[case]
    line = line_of(world(hull(added_mass='auto'), medium={'density': 1000} | values))
    assert line.startswith('fluid_sim.medium: model: ')
    for word in words:
        assert word in line


def test_two_media_are_refused():
    xml = world(hull(added_mass='auto'), medium=SEA)
    xml = xml.replace('</instance>', '</instance><instance name="other"/>', 1)
    assert 'one per model' in line_of(xml)


def test_an_instance_on_no_body_is_refused():
    xml = world(free_body(HULL), medium=SEA).replace(
        '<plugin plugin="fluid_sim.body"/>',
        '<plugin plugin="fluid_sim.body"><instance name="hydro"/></plugin>',
    )
    line = line_of(xml)
    assert "instance 'hydro'" in line
    assert 'on no body' in line


@pytest.mark.parametrize('key', ['added_mas', 'Volume'])
def test_unknown_key_is_refused_with_the_known_ones(key):
    line = line_of(world(hull(**{key: 1}), medium=SEA))
    assert f"unknown key '{key}'" in line
    for known in ('added_mass', 'volume', 'linear_damping', 'drag_reynolds'):
        assert known in line


STOCK = {
    'drag ellipsoid': (hull(drag='ellipsoid'), ['drag', 'builtin', 'density="0"']),
    'drag inertia box': (hull(drag='inertia_box'), ['drag', 'builtin', 'density="0"']),
    'drag none': (hull(added_mass='auto', drag='none'), ['drag', 'builtin']),
    'damping': (hull(linear_damping=[1] * 6), ['damping', "MuJoCo's own drag", 'density="0"']),
}


@pytest.mark.parametrize('case', STOCK)
@pytest.mark.parametrize('option', ['density="1000"', 'viscosity=".001"'])
def test_double_counting_with_the_stock_fluid_is_refused(case, option):
    bodies, words = STOCK[case]
    line = line_of(world(bodies, option=option))
    for word in words:
        assert word in line


def test_damping_beside_stock_drag_when_asked_for():
    load(world(hull(linear_damping=[1] * 6, drag='builtin'), option='density="1000"'))


def test_a_medium_that_differs_from_the_stock_fluid_is_refused():
    line = line_of(
        world(hull(added_mass='auto'), option='density="1000"', medium={'density': 1025})
    )
    assert 'opt.density' in line
    assert 'density="0"' in line


def test_a_surface_beside_stock_drag_is_refused():
    xml = world(hull(added_mass='auto'), option='density="1000"', medium={'surface': 0})
    assert 'opt.density' in line_of(xml)


def test_a_medium_equal_to_the_stock_fluid_is_accepted():
    load(world(hull(added_mass='auto'), option='density="1000"', medium={'density': 1000}))


def test_no_density_is_refused():
    for values in ({'added_mass': 'auto'}, {'volume': 1}, {'drag': 'ellipsoid'}):
        assert 'no density' in line_of(world(hull(**values)))


def test_a_surface_needs_to_know_the_depth_of_the_body():
    inside = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    xml = world(free_body(inside + body_plugin(added_mass=[1] * 6)), medium=SEA | {'surface': 0})
    assert 'geoms or volume' in line_of(xml)


def test_disabled_passive_flags_are_refused():
    line = line_of(
        world(hull(added_mass='auto'), medium=SEA, flag='spring="disable" damper="disable"')
    )
    assert 'spring and damper' in line


def test_open_mesh_is_refused():
    mesh = (
        '<asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1" face="0 2 1 0 1 3 0 3 2"'
        ' inertia="shell"/></asset>'
    )
    body = free_body('<geom type="mesh" mesh="m"/>' + body_plugin(volume='auto'))
    assert 'open surface' in line_of(world(body, medium=SEA, extra=mesh))


@pytest.fixture
def warnings(tmp_path, monkeypatch, capfd):
    """Return a function that loads MJCF and gives what MuJoCo prints as warnings."""
    monkeypatch.chdir(tmp_path)  # MuJoCo keeps a log of warnings in the working directory

    def run(xml):
        load(xml)
        return capfd.readouterr().err

    return run


def test_pgs_and_sleep_are_warned_about(warnings):
    xml = world(hull(added_mass='auto'), medium=SEA)
    assert warnings(xml) == ''
    pgs = warnings(xml.replace('<option ', '<option solver="PGS" '))
    assert 'PGS' in pgs
    assert 'Newton' in pgs
    sleep = warnings(xml.replace('contact="disable"', 'sleep="enable"'))
    assert 'sleeping body' in sleep


def test_a_change_of_options_that_data_refuses_points_to_the_warning(warnings, capfd):
    model, _ = load(world(hull(added_mass='auto'), option='density="1000"'))
    model.opt.density = 0
    with pytest.raises(mujoco.FatalError) as caught:
        mujoco.MjData(model)
    assert 'WARNING' in load_error_line(caught.value)
    assert 'no density' in capfd.readouterr().err


def test_other_errors_come_back_on_one_line():
    with pytest.raises(ValueError, match='XML') as caught:
        mujoco.MjModel.from_xml_string('<mujoco><nonsense/></mujoco>')
    assert '\n' not in load_error_line(caught.value)
    assert 'nonsense' in load_error_line(caught.value)


@pytest.mark.parametrize('gravity', ['0 0 9.81', '1 0 -9.81', '0 -9.81 0', '9.81 0 0', '0 .1 0'])
@pytest.mark.parametrize('waves', [{}, {'waves': 'regular .2 5'}])
def test_gravity_not_along_minus_z_with_a_surface_is_refused(gravity, waves):
    sea = SEA | {'surface': 0} | waves
    xml = world(hull(volume='auto'), medium=sea, gravity=[float(g) for g in gravity.split()])
    line = line_of(xml)
    assert line.startswith("fluid_sim.medium: model: surface = '0'")
    for word in ('gravity', '-z', '0 0 -g'):
        assert word in line


def test_gravity_in_any_direction_without_a_surface():
    for gravity in ([0, 0, 9.81], [1, 2, -3]):
        model, data = load(world(hull(volume='auto', drag='none'), medium=SEA, gravity=gravity))
        volume = 4 / 3 * np.pi * 0.3 * 0.2 * 0.1
        mujoco.mj_forward(model, data)
        np.testing.assert_allclose(
            data.qfrc_passive[:3], -1000 * volume * np.array(gravity), rtol=1e-12
        )


def test_a_surface_without_gravity_lies_where_it_is_stated():
    load(world(hull(volume='auto'), medium=SEA | {'surface': 0}, gravity=[0, 0, 0]))
