# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Parts that no log knows, a load on a cord: carried along the measured motion, then flown."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.resources import models_folder
from test.support.paths import ROOT

PAYLOAD = ROOT.parent / 'shared' / 'reference' / 'flights' / 'crazyflie_payload_10.usd'
#: Of the payload flight [kg], [m]: masses as its description has them; the length of the cord is
#: the one of .2 to 1 m at which the accelerometer along x is followed best.
VEHICLE, LOAD, CORD = 0.0397, 0.0047, 0.5


def test_a_load_of_ours_is_where_it_was_from_the_motion_of_the_vehicle_alone(tmp_path):
    scene = tmp_path / 'slung.yaml'
    scene.write_text(
        f'model: {models_folder() / "x500_slung_load"}.xml\nvehicles: {{x500: x500}}\n'
        'keyframe: hover\nduration: 3.0\nschedule: [{at: 0.3, wind: [4, 0, 0]}]\n'
    )
    assert main(['run', str(scene), '--hold', '--record', str(tmp_path / 'log.mcap')]) == 0
    flight = read_flight(next(tmp_path.rglob('*.mcap')))

    found = compare(flight, 'x500_slung_load', part=Part(horizons=(0.5,)))

    assert np.ptp(flight.signals['position'].values[:, 0]) > 0.05
    # the log of 100 Hz is what rounds: the load follows the vehicle between two samples
    assert np.median(found.errors['position_m']) < 2e-4
    assert np.median(found.errors['attitude_deg']) < 0.05
    assert any('load: in no log' in line for line in found.numbers['notes'])
    # and it counts: as a part of the vehicle, the load turns it otherwise
    rigid = compare(flight, 'x500', part=Part(horizons=(0.5,)))
    assert np.median(rigid.errors['position_m']) > 20 * np.median(found.errors['position_m'])


def crazyflie(folder, mass, load=0.0):
    """Write the crazyflie_37g with another mass, and a load on a cord."""
    load_plugins()
    spec = mujoco.MjSpec.from_file(str(models_folder() / 'crazyflie_37g.xml'))
    base = next(body for body in spec.bodies if body.joints)
    base.mass = mass
    if load:
        base.add_site(name='hook', pos=[0, 0, -0.01])
        below = spec.worldbody.add_body(name='load', pos=base.pos - np.array([0, 0, 0.01 + CORD]))
        below.add_freejoint()
        below.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.008, 0, 0], mass=load)
        below.add_site(name='eye')
        cord = spec.add_tendon(
            name='cord', limited=True, range=[0, CORD], solref_limit=[0.01, 1],
            solimp_limit=[0.99, 0.999, 0.001, 0.5, 2],
        )  # fmt: skip
        cord.wrap_site('hook')
        cord.wrap_site('eye')
    spec.compile()
    path = folder / f'crazyflie_{1e6 * mass:.0f}_{1e6 * load:.0f}.xml'
    path.write_text(spec.to_xml())
    return str(path)


@pytest.mark.skipif(
    not PAYLOAD.exists(), reason='the recordings of the payload flights are not here'
)
def test_a_real_flight_with_a_load_is_told_from_one_without(tmp_path):
    flight = read_flight(PAYLOAD)
    part = Part(begin=3.0, end=7.0, horizons=(0.5,))
    load, heavy, bare = (
        compare(flight, crazyflie(tmp_path, *masses), part=part)
        for masses in ((VEHICLE, LOAD), (VEHICLE + LOAD,), (VEHICLE,))
    )

    def force(found, axis):
        return found.numbers['residuals']['specific_force']['axes'][axis]['rms']

    assert force(bare, 'z') > 0.9  # [m/s^2]: the weight of the load
    assert force(load, 'z') < 0.35
    assert force(load, 'x') < 0.5 * min(force(heavy, 'x'), force(bare, 'x'))
    for name in ('position_m', 'attitude_deg'):
        assert np.median(load.errors[name]) < 0.8 * np.median(heavy.errors[name]), name
