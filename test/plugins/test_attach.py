# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Plugins of attached and replicated models: whole with named instances, refused where lost."""

import mujoco
import pytest

from fluid_sim_ros.errors import ModelError
from fluid_sim_ros.plugins.acting import acting_terms
from fluid_sim_ros.plugins.config import (
    BODY,
    THRUSTER,
    PluginInstance,
    plugin_of_actuator,
    plugin_of_body,
)
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.simulation import Simulation

ROTOR = {'curve': 'quadratic', 'thrust_coefficient': '1e-4', 'rad_s_max': '100'}


def keys(**values):
    return ''.join(f'<config key="{key}" value="{value}"/>' for key, value in values.items())


def child(hull, rotor='instance', extra=''):
    """Return a hull with a thruster; ``hull`` is its volume if inline, else the instance's."""
    inline = isinstance(hull, float)
    instances = '' if inline else f'<instance name="hydro">{keys(volume=hull)}</instance>'
    plugin = f'>{keys(volume=hull)}</plugin>' if inline else ' instance="hydro"/>'
    named = rotor == 'instance'
    rotors = f'<instance name="rotor">{keys(**ROTOR)}</instance>' if named else ''
    drive = ' instance="rotor"/>' if named else f'>{keys(**ROTOR)}</plugin>'
    return f"""<mujoco model="child"><extension>
    <plugin plugin="fluid_sim.body">{instances}{extra}</plugin>
    <plugin plugin="fluid_sim.thruster">{rotors}</plugin></extension>
    <worldbody><body name="hull" simple="false"><freejoint/><geom size=".1" mass="9"/>
    <plugin plugin="fluid_sim.body"{plugin}<site name="prop"/></body></worldbody>
    <actuator><plugin name="T" plugin="fluid_sim.thruster" site="prop" gear="0 0 1 0 0 0"{drive}
    </actuator></mujoco>"""


SEA = (
    '<plugin plugin="fluid_sim.medium"><instance name="sea">'
    f'{keys(density=1000)}</instance></plugin>'
)


def parent(inside='', extension=''):
    return (
        f'<mujoco><extension>{SEA}{extension}</extension><worldbody>{inside}</worldbody></mujoco>'
    )


def by_spec(children, base=None):
    """Return a spec with children attached by MjSpec."""
    native()
    spec = mujoco.MjSpec.from_string(base or parent())
    for i, text in enumerate(children):
        frame = spec.worldbody.add_frame(pos=[i, 0, 0])
        frame.attach_body(mujoco.MjSpec.from_string(text).body('hull'), f'v{i}_', '')
    return spec


def by_xml(folder, children, base=None):
    """Return the path of a model with children attached by <attach>."""
    models, frames = '', ''
    for i, text in enumerate(children):
        (folder / f'child{i}.xml').write_text(text)
        models += f'<model name="child{i}" file="child{i}.xml"/>'
        frames += (
            f'<frame pos="{i} 0 0"><attach model="child{i}" body="hull" prefix="v{i}_"/></frame>'
        )
    text = (base or parent()).replace('<worldbody>', f'<worldbody>{frames}')
    path = folder / 'parent.xml'
    path.write_text(text.replace('<mujoco>', f'<mujoco><asset>{models}</asset>'))
    return path


def compiled(way, folder, children, base=None):
    native()
    if way == 'MjSpec':
        return by_spec(children, base).compile()
    return mujoco.MjModel.from_xml_path(str(by_xml(folder, children, base)))


WAYS = ['MjSpec', '<attach>']


@pytest.mark.parametrize('way', WAYS)
def test_named_instances_of_several_attached_children_stay_their_own(way, tmp_path):
    volumes = ['.01', '.02', '.03']
    model = compiled(way, tmp_path, [child(volume) for volume in volumes])
    for i, volume in enumerate(volumes):
        body = model.body(f'v{i}_hull').id
        hull = plugin_of_body(model, body, BODY)
        assert hull.text('volume') == volume
        assert acting_terms(model, [body])[body] == ('drag', 'buoyancy')
        actuator = model.actuator(f'v{i}_T').id
        rotor = plugin_of_actuator(model, actuator, THRUSTER)
        assert rotor.text('rad_s_max') == '100'
    data = mujoco.MjData(model)
    data.ctrl[:] = [0.1, 0.2, 0.3]
    mujoco.mj_forward(model, data)
    assert data.actuator_force == pytest.approx([0.1, 0.2, 0.3])


LOST = {
    'the only child': ([child(0.02)], None, "'v0_hull'", BODY),
    'two children': ([child(0.02), child(0.03)], None, "'v0_hull'", BODY),
    'the second of two': ([child('.01'), child(0.03)], None, "'v1_hull'", BODY),
    'beside a named instance of the same kind': (
        [child(0.02, extra=f'<instance name="a">{keys(volume=1)}</instance>')],
        parent(
            '<body name="own" simple="false"><freejoint/><geom size=".1"/>'
            '<plugin plugin="fluid_sim.body" instance="a"/></body>',
            f'<plugin plugin="fluid_sim.body"><instance name="a">{keys(volume=1)}</instance>'
            f'<instance name="b">{keys(volume=2)}</instance></plugin>',
        ).replace('<instance name="b">', '<instance name="b">'),
        "'v0_hull'",
        BODY,
    ),
}


@pytest.mark.parametrize('case', LOST)
def test_a_plugin_that_attach_has_dropped_is_refused_before_it_is_another_ones(case, tmp_path):
    """By the path of the model, as every command and the node load it: with one line."""
    children, base, name, plugin = LOST[case]
    path = by_xml(tmp_path, children, base)
    with pytest.raises(ModelError) as caught:
        Simulation(path)
    line = str(caught.value)
    assert '\n' not in line
    for word in (str(path), name, plugin, 'attach', 'instance="..."'):
        assert word in line


@pytest.mark.parametrize('way', WAYS)
@pytest.mark.parametrize('case', ['two children', 'the only child'])
def test_the_library_itself_refuses_a_plugin_of_the_wrong_kind(way, case, tmp_path):
    """Without our loader, too: a hull with a thruster's instance, or with one that is none."""
    children, base, name, _ = LOST[case]
    with pytest.raises(ValueError, match='plugin') as caught:
        compiled(way, tmp_path, children, base)
    line = load_error_line(caught.value)
    assert 'attach' in line
    assert 'instance="..."' in line
    if case != 'the only child':
        assert name in line


def test_a_body_that_got_the_unnamed_instance_of_another_body_is_refused():
    """The parent's own hull is configured inside itself; the child's number points there."""
    own = (
        '<body name="own" simple="false"><freejoint/><geom size=".2"/>'
        f'<plugin plugin="fluid_sim.body">{keys(volume=0.5)}</plugin></body>'
    )
    plain = child(0.02).replace(child(0.02)[child(0.02).index('<actuator>') :], '</mujoco>')
    plain = plain.replace('<plugin plugin="fluid_sim.thruster">', '').replace(
        f'<instance name="rotor">{keys(**ROTOR)}</instance></plugin>', ''
    )
    base = parent(own, '<plugin plugin="fluid_sim.body"/>').replace(SEA, '')
    base = base.replace('<mujoco>', '<mujoco><option density="1000"/>')
    with pytest.raises(ValueError, match='plugin') as caught:
        by_spec([plain], base).compile()
    line = load_error_line(caught.value)
    assert "body 'v0_hull'" in line
    assert "body 'own'" in line
    assert 'attach' in line


def replicated(text):
    text = text.replace('<worldbody>', '<worldbody><replicate count="3" offset="1 0 0">')
    return text.replace('</worldbody>', '</replicate></worldbody>').replace(
        '<extension>', f'<extension>{SEA}'
    )


def test_replicate_copies_named_instances():
    """Without actuators that have plugins; see below."""
    native()
    text = child('.01')
    text = text[: text.index('<actuator>')] + '</mujoco>'
    text = text.replace(f'<instance name="rotor">{keys(**ROTOR)}</instance>', '')
    model = mujoco.MjModel.from_xml_string(replicated(text))
    instances = {int(model.body_plugin[model.body(f'hull{i}').id]) for i in range(3)}
    assert len(instances) == 3
    assert {PluginInstance(model, i).text('volume') for i in instances} == {'.01'}
    for body, terms in acting_terms(model, range(1, 4)).items():
        assert terms == ('drag', 'buoyancy'), body


@pytest.mark.parametrize('rotor', ['instance', 'inline'])
def test_a_replicate_that_crashes_mujoco_is_refused_before_it_does(rotor, tmp_path):
    """Named instances of bodies in <replicate> beside actuators with plugins: use after free."""
    path = tmp_path / 'fleet.xml'
    path.write_text(replicated(child('.01', rotor=rotor)))
    with pytest.raises(ModelError) as caught:
        Simulation(path)
    for word in (str(path), '<replicate>', 'segmentation fault', 'inside the body'):
        assert word in str(caught.value)
    path.write_text(replicated(child(0.02, rotor=rotor)).replace(
        f'<instance name="hydro">{keys(volume=0.02)}</instance>', ''))  # fmt: skip
    simulation = Simulation(path)  # the remedy
    assert len(simulation.vehicles) == 3
    simulation.close()


def test_replicated_bodies_may_share_what_is_configured_inside_them():
    native()
    text = child(0.02)
    text = text[: text.index('<actuator>')] + '</mujoco>'
    text = text.replace(f'<instance name="rotor">{keys(**ROTOR)}</instance>', '')
    model = mujoco.MjModel.from_xml_string(replicated(text))
    assert len({int(i) for i in model.body_plugin[1:]}) == 1
    for terms in acting_terms(model, range(1, 4)).values():
        assert terms == ('drag', 'buoyancy')


@pytest.mark.parametrize('way', [*WAYS, '<replicate>'])
def test_rotors_that_are_configured_inside_their_actuators_stay_whole(way, tmp_path):
    """MuJoCo loses those of bodies only."""
    if way == '<replicate>':
        text = child(0.01, rotor='inline')
        native()
        model = mujoco.MjModel.from_xml_string(replicated(text))
    else:
        model = compiled(way, tmp_path, [child('.01', rotor='inline')] * 3)
    rotors = [plugin_of_actuator(model, i, THRUSTER) for i in range(3)]
    assert len({rotor.index for rotor in rotors}) == 3
    data = mujoco.MjData(model)
    data.ctrl[:] = [0.1, 0.2, 0.3]
    mujoco.mj_forward(model, data)
    assert data.actuator_force == pytest.approx([0.1, 0.2, 0.3])


def test_an_instance_that_two_thrusts_share_is_refused():
    native()
    text = (
        child('.01')
        .replace(
            '</actuator>',
            '<plugin name="U" plugin="fluid_sim.thruster" instance="rotor" site="prop" '
            'gear="0 0 1 0 0 0"/></actuator>',
        )
        .replace('<extension>', f'<extension>{SEA}')
    )
    with pytest.raises(ValueError, match='plugin') as caught:
        mujoco.MjModel.from_xml_string(text)
    assert "actuator 'U': its instance drives another actuator" in load_error_line(caught.value)
