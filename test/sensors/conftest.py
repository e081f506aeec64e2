# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A brick in free space with sites to put sensors at."""

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.schema.scene import VehicleFile
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite

#: Mass 2 kg; inertia .02, .03, .04 kg m^2.
MODEL = """
<mujoco>
  <option timestep="0.002" gravity="0 0 {gravity}" density="{density}"/>
  <worldbody>
    <geom name="floor" type="plane" size="9 9 .1" pos="0 0 {floor}" contype="0" conaffinity="0"/>
    <body name="brick" pos="0 0 1">{joint}
      <inertial mass="2" pos="0 0 0" diaginertia=".02 .03 .04"/>
      <geom type="box" size=".1 .1 .1" contype="0" conaffinity="0"/>
      <site name="ahead" pos=".3 -.2 .1"/>
      <site name="turned" pos=".3 -.2 .1" euler="20 30 40"/>
      <site name="down" pos="0 0 -.1" xyaxes="1 0 0 0 -1 0"/>
    </body>
    <body name="other"><site name="elsewhere"/></body>
  </worldbody>
  <sensor>
    <accelerometer site="turned"/><gyro site="turned"/>
  </sensor>
</mujoco>
"""


@pytest.fixture
def brick(tmp_path):
    """Return a function that makes a simulation of the brick with sensors as in YAML."""

    def make(gravity=-9.81, fixed=False, density=0, floor=0, seed=0, home=None, **sensors):
        path = tmp_path / 'brick.xml'
        joint = '' if fixed else '<freejoint/>'
        path.write_text(MODEL.format(gravity=gravity, joint=joint, density=density, floor=floor))
        file = VehicleFile(body='brick', sensors=SensorsFile.model_validate(sensors))
        options = {} if home is None else {'home': home}
        return Simulation(Scene('brick', path, vehicles={'brick': file}, **options), seed=seed)

    return make


@pytest.fixture
def readings():
    """Return a function that runs a simulation and collects every new reading of a sensor."""

    def collect(simulation, kind, count, **options):
        suite = SensorSuite(simulation, next(iter(simulation.vehicles)), **options)
        sensor = getattr(suite, kind)
        kept, times = [], []
        while len(kept) < count:
            suite.update()
            if sensor.fresh:
                kept.append(sensor.values.copy())
                times.append((simulation.time_ns, sensor.time_ns))
            simulation.step(suite.period)
        return np.array(kept), times

    return collect
