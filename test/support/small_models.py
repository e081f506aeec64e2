# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MJCF of small models: a boat with a fin in stock water, and a buoy with plugins at a surface."""

TWO_PARTS = """
<mujoco>
  <option density="1000" viscosity="1e-3" timestep="0.002" integrator="implicitfast"
          wind=".3 -.2 .1"/>
  <worldbody>
    <body name="boat"><freejoint/>
      <geom type="ellipsoid" size=".3 .2 .1" density="900" fluidshape="ellipsoid"
            pos=".02 .01 0" euler="10 20 30"/>
      <site name="s" pos=".1 0 0"/>
      <body name="fin" pos=".4 0 0"><joint name="hinge" axis="0 0 1"/>
        <geom type="box" size=".1 .01 .05"/></body>
    </body>
  </worldbody>
  <actuator>
    <motor name="push" site="s" gear="0 0 1 0 0 .1" ctrllimited="true" ctrlrange="-2 3"/>
    <motor name="turn" joint="hinge"/>
  </actuator>
</mujoco>
"""

AMPHIBIOUS = """
<mujoco>
  <option timestep="0.002" integrator="implicitfast"/>
  <extension>
    <plugin plugin="fluid_sim.body"/>
    <plugin plugin="fluid_sim.medium"><instance name="sea">
      <config key="surface" value="0"/><config key="density" value="1000"/>
      <config key="viscosity" value="1e-3"/><config key="density_above" value="1.2"/>
      <config key="viscosity_above" value="1.8e-5"/><config key="current" value=".1 0 0"/>
    </instance></plugin>
  </extension>
  <worldbody><body name="buoy" pos="0 0 -1" simple="false"><freejoint/>
    <geom type="ellipsoid" size=".3 .2 .1" density="500" fluidshape="ellipsoid"/>
    <plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/>
      <config key="volume" value="auto"/><config key="drag" value="ellipsoid"/></plugin>
  </body></worldbody>
</mujoco>
"""
