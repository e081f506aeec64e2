# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Advice and charts of models that others wrote: bodies without names, plugins on them."""

import json

import pytest

from fluid_sim_ros.cli.main import main
from fluid_sim_ros.lab.advisor.advise import advise
from fluid_sim_ros.lab.charts.measure import measure
from fluid_sim_ros.lab.problems.catalogue import problem

#: A hull with a nameless fin, and a nameless free body beside it; all have the plugin.
NAMELESS = """<mujoco><option timestep="0.005" gravity="0 0 0"/>
<extension><plugin plugin="fluid_sim.body"/><plugin plugin="fluid_sim.medium">
<instance name="sea"><config key="density" value="1000"/></instance></plugin></extension>
<worldbody><body name="hull" simple="false"><freejoint/>
<geom type="ellipsoid" size=".3 .2 .1" density="900" fluidshape="ellipsoid"/>
<plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/></plugin>
<body pos="-.4 0 0" simple="false"><joint axis="0 0 1" damping=".1"/>
<geom type="ellipsoid" size=".1 .01 .1" density="900" fluidshape="ellipsoid"/>
<plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/></plugin></body></body>
{beside}</worldbody>
<keyframe><key name="start" qvel="1 .2 0 0 0 .5 1{rest}"/></keyframe></mujoco>"""
FREE = """<body pos="3 0 0" simple="false"><freejoint/>
<geom type="ellipsoid" size=".1 .1 .1" density="900" fluidshape="ellipsoid"/>
<plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/></plugin></body>"""


@pytest.fixture(params=['a link', 'a link and a free body'])
def scene(request, tmp_path):
    free = request.param.endswith('free body')
    text = NAMELESS.format(beside=FREE if free else '', rest=' 0' * 6 if free else '')
    (tmp_path / 'nameless.xml').write_text(text)
    path = tmp_path / 'nameless.yaml'
    path.write_text(
        'model: nameless.xml\nvehicles: {hull: {body: hull}}\nkeyframe: start\nduration: 1.0\n'
    )
    return str(path)


def test_advice_for_a_nameless_body_with_the_plugin(scene):
    found = advise(scene, 0.05)
    assert found['choice']['rung'] == 'scene'
    assert {row['rung'] for row in found['not_tried'] if not row['integrator']} >= {'none'}


def test_a_chart_of_a_nameless_body_with_the_plugin(scene):
    case = problem(scene)
    assert list(case.rungs) == ['none', 'inertia', 'ellipsoid', 'no_added_mass', 'scene']
    result = measure(case, integrators=('RK4',), timesteps=(0.01, 0.005), rounds=1)
    assert all(point['status'] == 'ok' for point in result['points'])


def test_stability_of_a_nameless_body_with_the_plugin(scene, tmp_path, capsys):
    arguments = ['stability', scene, '--cells', '2', '--integrators', 'RK4', '--json', '-']
    assert main([*arguments, '--out', str(tmp_path / 'out')]) == 0
    assert json.loads(capsys.readouterr().out)['largest_steps'][0]['largest_s'] > 0


def test_advice_for_an_mjcf_file_whose_free_body_has_no_name(tmp_path):
    text = NAMELESS.format(beside=FREE, rest=' 0' * 6)
    (tmp_path / 'plain.xml').write_text(text)
    assert advise(str(tmp_path / 'plain.xml'), 0.05, duration=0.5)['choice']
