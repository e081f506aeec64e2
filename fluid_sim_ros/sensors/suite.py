"""All sensors of a vehicle, sampled at step boundaries."""

import math

from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors.airspeed import Airspeed
from fluid_sim_ros.sensors.beams import Dvl, Rangefinder
from fluid_sim_ros.sensors.gnss import Gnss
from fluid_sim_ros.sensors.imu import Imu
from fluid_sim_ros.sensors.magnetometer import Magnetometer
from fluid_sim_ros.sensors.pressure import Barometer, WaterPressure
from fluid_sim_ros.sensors.sensor import Carrier, SavedSensor, Sensor
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER


class SensorSuite:
    """
    The sensors of a vehicle.

    Call ``update`` at every step that ``period`` divides, step 0 included; a simulation that has
    gone back in time (a reset) makes every sensor begin anew. Made for the timestep that the
    simulation has now.

    Parameters
    ----------
    simulation
        What is measured; reading never changes its trajectory.
    vehicle
        Name of the vehicle.
    config
        Its sensors; default: those of its file.
    seed
        Of the random numbers; default: the simulation's.

    Attributes
    ----------
    imu, magnetometer, barometer, pressure, gnss, airspeed, rangefinder, dvl
        Each a sensor, or None where the vehicle has none.
    sensors
        Those that there are.
    period
        Greatest common divisor of all periods and latencies [steps].

    Raises
    ------
    CommandError, ConfigError
        If there is no such vehicle, or a sensor does not fit the model.

    """

    def __init__(
        self,
        simulation: Simulation,
        vehicle: str,
        config: SensorsFile | None = None,
        seed: int | None = None,
    ) -> None:
        target = simulation.vehicle(vehicle)
        if config is None:
            config = target.sensors
        index = list(simulation.vehicles).index(vehicle)
        self._simulation = simulation
        carrier = Carrier(
            simulation, target, simulation.observe(forces=False)[index],
            simulation.seed if seed is None else seed, config.dither,
        )  # fmt: skip
        c = config
        self.imu = Imu(carrier, c.imu) if c.imu else None
        self.magnetometer = Magnetometer(carrier, c.magnetometer) if c.magnetometer else None
        self.barometer = Barometer(carrier, c.barometer) if c.barometer else None
        self.pressure = WaterPressure(carrier, c.pressure) if c.pressure else None
        self.gnss = Gnss(carrier, c.gnss) if c.gnss else None
        self.airspeed = Airspeed(carrier, c.airspeed) if c.airspeed else None
        self.rangefinder = Rangefinder(carrier, c.rangefinder) if c.rangefinder else None
        self.dvl = Dvl(carrier, c.dvl) if c.dvl else None
        each = (
            self.imu, self.magnetometer, self.barometer, self.pressure, self.gnss, self.airspeed,
            self.rangefinder, self.dvl,
        )  # fmt: skip
        self.sensors: tuple[Sensor, ...] = tuple(sensor for sensor in each if sensor)
        periods = [steps for s in self.sensors for steps in (s.period, s.latency)]
        self.period = math.gcd(*periods) or NEVER

    def update(self) -> None:
        """Sample what is due at this step boundary."""
        simulation = self._simulation
        tick = simulation.tick
        due = forces = False
        for sensor in self.sensors:
            if tick % sensor.period == 0:
                due, forces = True, forces or sensor.needs_forces
        if due:
            simulation.observe(forces, wrenches=False)
        self.read(tick, simulation.time_ns)

    def read(self, tick: int, time_ns: int) -> None:
        """Sample what is due, of a state that the caller has observed (with forces if needed)."""
        for sensor in self.sensors:
            if tick % sensor.period == 0 or sensor.under_way or tick <= sensor.step:
                sensor.update(tick, time_ns)
            else:
                sensor.fresh = False

    def reset(self) -> None:
        """Forget every reading, as after a reset to another state at the same step."""
        for sensor in self.sensors:
            sensor.reset()

    def save_state(self) -> dict[str, SavedSensor]:
        """Return the present readings and those under way; to be kept with the simulation's."""
        return {sensor.config.kind: sensor.save_state() for sensor in self.sensors}

    def load_state(self, saved: dict[str, SavedSensor]) -> None:
        """Go on from a saved state of the same suite."""
        for sensor in self.sensors:
            sensor.load_state(saved[sensor.config.kind])
