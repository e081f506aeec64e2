"""What ArduPilot gets to know of its vehicle at the end of each frame."""

import math

from fluid_sim_ros.mavlink.ardupilot.json_packets import JsonState
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.ned import euler
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.mavlink.vehicle_truth import Truth, TruthReader
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

#: What a rangefinder without an echo says [m].
_OUT_OF_RANGE = 1000.0


class StateReader:
    """
    Reads the true state, and the sensors that ArduPilot does not make up itself.

    Parameters
    ----------
    simulation, vehicle
        Where the vehicle is, and its name.
    sticks
        Of a radio control.
    battery
        What its monitor measures, or None.

    """

    def __init__(
        self, simulation: Simulation, vehicle: str, sticks: Sticks, battery: Battery | None
    ) -> None:
        self._simulation, self._sticks, self._battery = simulation, sticks, battery
        self._truth = TruthReader(simulation, vehicle)
        self._suite = _sensors(simulation, vehicle)
        self._aerial = simulation.streams == ('wind',)

    def read(self, time_s: float) -> JsonState:
        """
        Return the present state.

        Parameters
        ----------
        time_s
            Time of the state by the autopilot's clock [s].

        Returns
        -------
        JsonState
            NED and FRD axes.

        """
        truth = self._truth.read(forces=True)
        air, vane = (truth.air_ned, _vane(truth)) if self._aerial else (None, None)
        battery = self._battery
        return JsonState(
            time_s, truth.rates, truth.specific_force, truth.position_ned, truth.velocity_ned,
            truth.attitude, air, *self._measure(), vane, self._sticks.pulses(),
            None if battery is None else (battery.voltage, battery.current),
        )  # fmt: skip

    def _measure(self) -> tuple[float | None, float | None]:
        """Return airspeed and distance to the ground where the vehicle has sensors for them."""
        suite, simulation = self._suite, self._simulation
        suite.read(simulation.tick, simulation.time_ns)  # the truth's reader has observed
        airspeed = suite.airspeed.airspeed if suite.airspeed else None
        if suite.rangefinder is None:
            return airspeed, None
        return airspeed, min(max(suite.rangefinder.distance, 0.0), _OUT_OF_RANGE)


def _vane(truth: Truth) -> tuple[float, float]:
    """Return where the wind comes from, clockwise from ahead [rad], and its speed [m/s]."""
    north, east, _ = (v - a for v, a in zip(truth.velocity_ned, truth.air_ned, strict=True))
    speed = math.hypot(north, east)
    heading = euler(truth.attitude)[2]
    return (math.remainder(math.atan2(east, north) - heading, math.tau) if speed else 0.0), speed


def _sensors(simulation: Simulation, vehicle: str) -> SensorSuite:
    """Return the sensors, read at every frame."""
    config, chosen = simulation.vehicle(vehicle).sensors, {}
    for kind in ('rangefinder', 'airspeed'):
        sensor = getattr(config, kind)
        if sensor is not None:
            rate = 1 / exact(simulation.timestep)
            chosen[kind] = sensor.model_copy(update={'rate': rate, 'latency': 0.0})
    return SensorSuite(simulation, vehicle, SensorsFile().model_copy(update=chosen))
