# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What load and watchdogs find stands in diagnostics and in the node's log."""

import pytest

from test.support.ros_processes import Peer, node, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

BALL = """
<mujoco>
  <option {option}/>
  <worldbody>
    <body name="ball" pos="0 0 100">
      <freejoint/>
      <geom type="ellipsoid" size=".1 .05 .02" mass="1" {fluid}/>
    </body>
  </worldbody>
</mujoco>
"""
LINK = '<geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/>'
CHAIN = f"""
<mujoco><option timestep="0.01" gravity="0 0 0"/><worldbody>
  <body name="chain"><freejoint/>{LINK}
    <body pos=".3 0 0"><joint axis="0 1 0"/>{LINK}
      <body pos=".3 0 0"><joint axis="0 0 1"/>{LINK}</body></body></body></worldbody>
  <keyframe><key name="spin" qvel="0 0 0 1 3 2 8 -6"/></keyframe></mujoco>
"""


def model(tmp_path, option, fluid=''):
    path = tmp_path / 'ball.xml'
    path.write_text(BALL.format(option=option, fluid=fluid))
    return str(path)


def test_a_load_warning_is_in_diagnostics_and_in_the_log(tmp_path):
    """A model in centimetres."""
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene=model(tmp_path, option='gravity="0 0 -981"')) as process:
            words = 'the model seems to be in centimetres'
            wait_until(
                lambda: words in peer.diagnostics.get('engine', (0, ''))[1], 'the load warning'
            )
        assert peer.diagnostics['engine'][0] == 1
        assert process.output.count(words) == 1


def test_the_terms_of_each_vehicle_are_in_diagnostics_and_in_the_log(tmp_path):
    path = model(tmp_path, option='density="1.2"', fluid='fluidshape="ellipsoid"')
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene=path) as process:
            wait_until(lambda: 'vehicle ball' in peer.diagnostics, 'diagnostics')
        terms = peer.diagnostics['vehicle ball'][2]['terms']
        assert 'drag' in terms
        assert f'ball: terms: {terms}' in process.output


def test_the_energy_watchdog_is_in_diagnostics_and_in_the_log(tmp_path):
    """An undamped chain, which Euler's method feeds with energy."""
    path = tmp_path / 'chain.yaml'
    path.with_suffix('.xml').write_text(CHAIN)
    path.write_text('model: chain.xml\nkeyframe: spin\n')
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene=str(path), realtime__factor=0.5) as process:
            words = 'the integrator has added'
            wait_until(lambda: words in peer.diagnostics.get('engine', (0, ''))[1], 'the watchdog')
            assert words in process.output
        assert peer.diagnostics['engine'][0] == 1
