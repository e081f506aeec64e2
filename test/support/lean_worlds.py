# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Worlds in which bodies come near each other, and a comparison with MuJoCo's whole steps."""

import mujoco
import numpy as np

from fluid_sim_ros import Simulation
from fluid_sim_ros.plugins.native import native

STATE = mujoco.mjtState.mjSTATE_INTEGRATION
#: What others read of the data after a step, beside the state.
READ = (
    'xpos', 'xquat', 'xmat', 'xipos', 'geom_xpos', 'geom_xquat', 'geom_xmat', 'site_xpos',
    'site_xmat', 'cam_xpos', 'cam_xmat', 'light_xpos', 'light_xdir', 'subtree_com', 'cvel', 'qacc',
    'qfrc_fluid', 'qfrc_passive', 'qfrc_actuator', 'qfrc_constraint', 'qfrc_bias',
    'actuator_force', 'actuator_length', 'actuator_velocity', 'moment_rownnz', 'moment_rowadr',
    'sensordata', 'ten_length', 'energy',
)  # fmt: skip

WORLD = """
<mujoco>
  <option timestep="{timestep}" integrator="{integrator}" density="1.2" viscosity="1.8e-5"/>
  <default><geom friction=".6 .01 .001"/></default>
  <worldbody>
    <light pos="0 0 3" mode="trackcom"/>
    <geom name="floor" type="plane" size="5 5 .1"/>
    <geom name="ceiling" type="box" size="4 4 .1" pos="0 0 3"/>
    <body name="post" pos="1 0 .5" euler="0 0 20">
      <geom type="cylinder" size=".1 .5"/><geom type="mesh" mesh="wedge" pos="0 0 .7"/>
    </body>
    <body name="one" pos="0 0 1"><freejoint/>
      <camera mode="trackcom" pos="1 1 1"/>
      <geom type="box" size=".1 .15 .05" mass=".5"/>
      <geom type="sphere" size=".02" pos=".2 0 0" contype="0" conaffinity="0"/>
      <geom type="capsule" size=".03 .1" pos="0 0 .05" mass=".1" margin=".01" gap=".004"/>
      <site name="push" pos="0 0 .1"/>
      <body pos="-.1 0 0"><joint name="arm" axis="0 1 0" range="-30 40" damping=".001"/>
        <geom type="capsule" fromto="0 0 0 -.2 0 0" size=".01" mass=".05"
              contype="0" conaffinity="0"/></body>
    </body>
    <body name="two" pos=".6 .1 1.2"><freejoint/>
      <geom type="ellipsoid" size=".1 .08 .06" mass=".3" fluidshape="ellipsoid"/>
      <geom type="sphere" size=".02" pos="-.2 0 0" contype="0" conaffinity="0"/>
    </body>
  </worldbody>
  <actuator><motor name="push" site="push" gear="0 0 1 0 .01 0" ctrlrange="0 40"/></actuator>
</mujoco>
"""
WEDGE = '<asset><mesh name="wedge" vertex="0 0 0 .2 0 0 0 .2 0 0 0 .2"/></asset>'


def world(path, integrator, timestep=0.002, edit=lambda text: text):
    """Return a simulation of the world, its MJCF edited."""
    text = WORLD.format(integrator=integrator, timestep=timestep)
    file = path / 'world.xml'
    file.write_text(edit(text.replace('<worldbody>', WEDGE + '<worldbody>', 1)))
    return Simulation(file)


class Beside:
    """A copy of a simulation's data that takes every step whole."""

    def __init__(self, simulation):
        self.model, self.data = simulation.model, mujoco.MjData(simulation.model)
        self._simulation, self._report = simulation, np.zeros(2)
        mujoco.mj_copyData(self.data, self.model, simulation.data)
        self.touched = self.apart = 0

    def both(self, write):
        """Let ``write(data)`` change the data of both."""
        for data in (self._simulation.data, self.data):
            write(data)

    def follow(self):
        """Begin at the simulation's state."""
        mujoco.mj_copyData(self.data, self.model, self._simulation.data)

    def step(self, n):
        """Step both, and hold them together to the bit."""
        self._simulation.step(n)
        assert self.take(n) == n
        self.compare()
        self.touched += self.data.ncon > 0
        self.apart += self._simulation.stages().without_contacts

    def take(self, n):
        """Take whole steps alone; returns how many were good."""
        addresses = self.model._address, self.data._address
        return native().step(*addresses, n, self._report.ctypes.data)

    def compare(self):
        """Compare states, and what others read of the data."""
        ours, whole = self._simulation.data, self.data
        size = mujoco.mj_stateSize(self.model, STATE)
        states = np.empty((2, size))
        mujoco.mj_getState(self.model, ours, states[0], STATE)
        mujoco.mj_getState(self.model, whole, states[1], STATE)
        assert states[0].tobytes() == states[1].tobytes(), 'state'
        assert (ours.ncon, ours.nefc) == (whole.ncon, whole.nefc)
        rows = slice(0, int(ours.moment_rownnz.sum()))
        for name in ('moment_colind', 'actuator_moment'):
            assert (getattr(ours, name)[rows] == getattr(whole, name)[rows]).all(), name
        for name in READ:
            assert getattr(ours, name).tobytes() == getattr(whole, name).tobytes(), name
