# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node says where a vehicle leaves the grid of its wind: in /diagnostics, once in its log."""

import numpy as np
import pytest

from test.support.ros_processes import Peer, node, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

MODEL = """<mujoco><option density="1.2" gravity="0 0 0" timestep="0.002"/><worldbody>
<body name="kite" pos="30 0 5"><freejoint/><geom size=".1"/></body></worldbody></mujoco>"""
LINE = "wind grid: 'kite' at x = 30"


def test_a_vehicle_beyond_the_grid_is_reported(tmp_path):
    (tmp_path / 'kite.xml').write_text(MODEL)
    np.savez(tmp_path / 'flow.npz', x=[-10.0, 10.0], u=[1.0, 2.0], v=[0.0, 0.0])
    scene = tmp_path / 'kite.yaml'
    scene.write_text('model: kite.xml\nwind: {model: grid, file: flow.npz}\n')
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene=scene) as process:
            for _ in range(2):
                wait_until(
                    lambda: 'beyond its end' in peer.diagnostics.get('engine', (0, ''))[1],
                    'a report of the grid',
                )
                level, message, _ = peer.diagnostics.pop('engine')
                assert level == 1
                assert LINE in message
        assert process.output.count('beyond its end at 10 m: the edge value holds') == 1
