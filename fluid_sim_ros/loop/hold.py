"""Holds vehicles where a run begins, by the control laws in process: no ROS, no delay."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fixed_wing import FixedWingCommand, FixedWingController, FlightTarget
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.torpedo import CruiseTarget, TorpedoController
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.loop.autopilot_commands import VehicleCommands
from fluid_sim_ros.loop.autopilot_port import CommandLog, Surroundings
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.step_clock import Beat

#: Answers per second of simulated time [Hz].
RATE = 100.0
#: Speed at which a torpedo is held that begins slower [m/s].
_CRUISE = 1.5
_FINS = ('rudder', 'planes')
_SURFACES = FixedWingCommand._fields[1:]


class Answer(NamedTuple):
    """Thrusts [N] and joint commands in the order of the vehicle's; no joints: left alone."""

    thrusts: Sequence[float]
    joints: Sequence[float] = ()


#: A law with what it holds.
Law = Callable[[State], Answer]


def state_of(simulation: Simulation, row: Array) -> State:
    """
    Return the state that a law is told of a vehicle.

    Parameters
    ----------
    simulation
        At a step boundary.
    row
        Of the vehicle, as ``Simulation.observe`` returned it.

    Returns
    -------
    State
        With the velocity of the medium.

    """
    return State(
        simulation.time, row[nat.POSITION].tolist(), row[nat.QUATERNION].tolist(),
        row[nat.LINEAR_VELOCITY].tolist(), row[nat.ANGULAR_VELOCITY].tolist(),
        row[nat.MEDIUM_VELOCITY].tolist(),
    )  # fmt: skip


def law_of(plant: Plant, vehicle: Vehicle, begin: State) -> Law:
    """
    Return the law that fits a vehicle, holding the place, height and heading of a state.

    Parameters
    ----------
    plant
        Mass and thrusters.
    vehicle
        Its fins or surfaces tell a torpedo and an aircraft; of the others, one that buoyancy
        carries is held as an underwater vehicle, the rest as a multirotor.
    begin
        What to hold; an aircraft and a torpedo go on at its speed.

    Returns
    -------
    Law
        With its default gains.

    Raises
    ------
    ConfigError
        If the law does not fit the vehicle after all; says why.

    """
    r_wb = rot.from_quaternion(begin.quat_wb_wxyz)
    yaw, height = rot.yaw_of(r_wb), begin.position_w[2]
    joints = vehicle.joints
    if set(joints) == set(_FINS):
        torpedo = TorpedoController(plant, float(abs(vehicle.joint_range).min()))
        cruise = CruiseTarget(-height, yaw, max(begin.velocity_b[0], _CRUISE))

        def by_fins(state: State) -> Answer:
            thrust, *fins = torpedo.step(state, cruise)
            return Answer([thrust], [fins[_FINS.index(name)] for name in joints])

        return by_fins
    if set(joints) == set(_SURFACES):
        plane = FixedWingController(plant, float(abs(vehicle.joint_range).min()))
        flight = FlightTarget(height, yaw, begin.velocity_b[0])

        def by_surfaces(state: State) -> Answer:
            thrust, *surfaces = plane.step(state, flight)
            return Answer([thrust], [surfaces[_SURFACES.index(name)] for name in joints])

        return by_surfaces
    if plant.weight < 0.5 * plant.mass * GRAVITY:
        rov = UnderwaterController(plant)
        depth = DepthTarget(-height, yaw, place_w=begin.position_w)
        return lambda state: Answer(rov.step(state, depth))
    multirotor, pose = MultirotorController(plant), PoseTarget(begin.position_w, yaw)
    return lambda state: Answer(multirotor.step(state, pose))


class Hold:
    """
    A sink for the runner that commands every vehicle with thrusters; the last of the sinks.

    Parameters
    ----------
    simulation
        At its begin, which is held.
    log
        Gets every command before it takes effect, so that the run can be repeated; or None.

    Attributes
    ----------
    period
        Every tick at which it answers is a multiple of it.

    Raises
    ------
    ConfigError
        If no vehicle can be held, or the rate does not fit the timestep.

    """

    def __init__(self, simulation: Simulation, log: CommandLog | None = None) -> None:
        self._beat = Beat.at_rate(RATE, simulation.timestep, '--hold')
        self.period = self._beat.period
        self._held: list[tuple[int, Law, VehicleCommands]] = []
        rows = simulation.observe(forces=False).copy()
        for row, (name, vehicle) in enumerate(simulation.vehicles.items()):
            if vehicle.thrusters:
                plant, _ = plant_of(simulation.scene, name)
                law = law_of(plant, vehicle, state_of(simulation, rows[row]))
                commands = VehicleCommands(simulation, name, Surroundings(log=log))
                self._held.append((row, law, commands))
        if not self._held:
            raise ConfigError(
                f'--hold: no vehicle has thrusters; the scene has: {listed(simulation.vehicles)}'
            )

    def write(self, simulation: Simulation) -> None:
        """
        Answer the present state with commands.

        Parameters
        ----------
        simulation
            At a step boundary; commanded.

        """
        if not self._beat.due(simulation.tick):
            return
        rows = simulation.observe(forces=False)
        states = [state_of(simulation, rows[row]) for row, _, _ in self._held]
        for state, (_, law, commands) in zip(states, self._held, strict=True):
            commands.set(*law(state))
