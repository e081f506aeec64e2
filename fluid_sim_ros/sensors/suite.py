# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""All sensors of a vehicle, sampled at step boundaries."""

import math
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from fluid_sim_ros.schema.sensors import KINDS, SensorsFile
from fluid_sim_ros.sensors.airspeed import Airspeed
from fluid_sim_ros.sensors.beams import Dvl, Rangefinder
from fluid_sim_ros.sensors.camera import Camera
from fluid_sim_ros.sensors.gnss import Gnss
from fluid_sim_ros.sensors.imu import Imu
from fluid_sim_ros.sensors.magnetometer import Magnetometer
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.pressure import Barometer, WaterPressure
from fluid_sim_ros.sensors.scans import Lidar, Sonar
from fluid_sim_ros.sensors.sensor import CLASSES, SavedSensor, Sensor
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER

# every module of this folder enters its sensors into the table
for _module in iter_modules([str(Path(__file__).parent)]):
    import_module(f'{__package__}.{_module.name}')


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
    imu, magnetometer, barometer, pressure, gnss, airspeed, rangefinder, dvl, lidar, sonar,
    camera
        Each a sensor, or None where the vehicle has none: one for each key of ``sensors:``.
    sensors
        Those that there are.
    period
        Every step at which one measures or shows a reading is a multiple of it.

    Raises
    ------
    CommandError, ConfigError
        If there is no such vehicle, or a sensor does not fit the model.

    """

    imu: Imu | None
    magnetometer: Magnetometer | None
    barometer: Barometer | None
    pressure: WaterPressure | None
    gnss: Gnss | None
    airspeed: Airspeed | None
    rangefinder: Rangefinder | None
    dvl: Dvl | None
    lidar: Lidar | None
    sonar: Sonar | None
    camera: Camera | None

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
        sensors: list[Sensor] = []
        for kind in KINDS:
            file = getattr(config, kind)
            sensor = CLASSES[kind](carrier, file) if file else None
            setattr(self, kind, sensor)
            sensors += [sensor] if sensor else []
        self.sensors = tuple(sensors)
        periods = [steps for s in self.sensors for steps in (s.period, s.latency)]
        self.period = math.gcd(*periods) or NEVER

    def update(self) -> None:
        """Sample what is due at this step boundary."""
        simulation = self._simulation
        tick = simulation.tick
        due = forces = False
        for sensor in self.sensors:
            if sensor.beat.due(tick):
                due, forces = True, forces or sensor.needs_forces
        if due:
            simulation.observe(forces, wrenches=False)
        self.read(tick, simulation.time_ns)

    def read(self, tick: int, time_ns: int) -> None:
        """
        Sample what is due, of a state that the caller has observed (with forces if needed).

        Parameters
        ----------
        tick
            The present one.
        time_ns
            Its simulated time [ns].

        """
        for sensor in self.sensors:
            if sensor.beat.due(tick) or sensor.appears(tick):
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
        """
        Go on from a saved state of the same suite.

        Parameters
        ----------
        saved
            As ``save_state`` returned it.

        """
        for sensor in self.sensors:
            sensor.load_state(saved[sensor.config.kind])
