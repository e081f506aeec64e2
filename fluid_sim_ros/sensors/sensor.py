# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What every sensor shares: where it sits, when it measures, and how late its reading appears."""

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.sensors import SensorFile
from fluid_sim_ros.sensors.mount import Carrier, Mount
from fluid_sim_ros.sensors.noise import Errors
from fluid_sim_ros.sensors.pose import Posed
from fluid_sim_ros.sensors.reading import Reading
from fluid_sim_ros.step_clock import Beat, rounded_steps


@dataclass(frozen=True)
class SavedSensor:
    """What a sensor's next readings depend on besides the simulation's state."""

    step: int
    fresh: bool
    time_ns: int
    values: Array
    pending: tuple[tuple[int, int, Array], ...]


#: Class by the kind of sensor in the file: every class with ``file=`` in its head.
CLASSES: dict[str, type['Sensor']] = {}


class Sensor(Posed, ABC):
    """
    One sensor; ``values`` and the arrays of the subclasses are overwritten by each reading.

    Parameters
    ----------
    carrier
        The vehicle that it sits on.
    config
        Its place, rate, latency and errors.

    Attributes
    ----------
    where
        Scene, vehicle and sensor, as errors begin.
    config, mount
        As above, and where it sits.
    frame, frame_quat_bs
        Name of its coordinate frame, and the turn from that frame to base_link, scalar first.
    beat
        At which steps it measures.
    period, latency
        Every step at which it measures is a multiple of the period; steps from what is measured
        to its reading.
    step
        At which it was last updated; -1: never.
    under_way
        Readings that were taken and have not appeared yet: when they will [step], their time [ns],
        values.
    fresh
        A new reading has appeared at the last ``update``.
    time_ns
        Simulated time at which the present reading was true [ns]; -1 before the first.
    values
        The present reading, shape (n,).
    saturated
        How many values were beyond the range so far.
    errors
        Its errors and their random numbers.

    Raises
    ------
    ConfigError
        If the rate or the site does not fit the model.

    """

    #: What it measures: keys of its file that state the errors, and their numbers of axes.
    channels: ClassVar[tuple[tuple[str, int], ...]] = ()
    #: Quantum of each channel where it is to be dithered and has no resolution; (): no dither.
    dither: ClassVar[tuple[float, ...]] = ()
    #: Its topics, of the class or of one that has fewer.
    readings: tuple[Reading, ...] = ()
    #: Its numbers need ``Simulation.observe(forces=True)``.
    needs_forces: ClassVar[bool] = False
    #: Readings beyond the range are infinite instead of the range's end.
    infinite_beyond: ClassVar[bool] = False

    def __init_subclass__(cls, file: type[SensorFile] | None = None) -> None:
        """
        Enter a class into the table of sensors.

        Parameters
        ----------
        file
            Schema of the sensor that the class measures; None for a base of others.

        """
        if file is not None:
            CLASSES[file.kind] = cls

    def __init__(self, carrier: Carrier, config: SensorFile) -> None:
        simulation, vehicle = carrier.simulation, carrier.vehicle
        where = f"{simulation.scene.name}: vehicle '{vehicle.name}': sensors.{config.kind}"
        self.where = where
        self.config = config
        super().__init__(carrier.state, Mount.of_site(carrier, config.site, where))
        self.frame = f'{vehicle.name}/{config.kind}'
        self.frame_quat_bs = self.mount.quat_bs_wxyz.copy()
        self.beat = Beat.at_rate(config.rate, simulation.timestep, f'{where}.rate')
        self.period = self.beat.period
        self.latency, rounded = rounded_steps(
            config.latency, simulation.timestep, f'{where}.latency'
        )
        if rounded:
            simulation.warnings.add(rounded)
        self._simulation = simulation
        channels = [(getattr(config, key), count) for key, count in self.axes(config)]
        self.errors = Errors(
            channels, float(config.rate), carrier.seed, f'{vehicle.name}/{config.kind}',
            self.dither if carrier.dither else (), self.infinite_beyond,
        )  # fmt: skip
        width = sum(count for _, count in channels)
        self.values = np.zeros(width)
        # one row for each reading that may be under way, and one for the next
        self._rows = np.zeros((self.beat.index(self.latency + 1) + 2, width))
        self.under_way: deque[tuple[int, int, Array]] = deque()
        self.saturated = 0
        self.reset()

    def reset(self) -> None:
        """Forget every reading, as before the first; the count of saturations goes on."""
        self.step = -1
        self.fresh = False
        self.time_ns = -1
        self.values[:] = 0.0
        self.under_way.clear()

    def update(self, step: int, time_ns: int) -> None:
        """
        Measure if it is due, and show the reading that is.

        The caller has observed the state at this step boundary (with forces if due and needed).
        A second call at the same step changes nothing; a step that goes back forgets all.

        Parameters
        ----------
        step
            The present tick.
        time_ns
            Its simulated time [ns].

        """
        if step == self.step:
            return
        if step < self.step:
            self.reset()
        elif step > self.step + self.beat.longest:  # nobody asked for some time
            self.under_way.clear()
        self.step = step
        self.fresh = False
        if self.beat.due(step):
            index = self.beat.index(step)
            row = self._rows[index % len(self._rows)]
            if self._measure(row):
                self.saturated += self.errors.apply(index, row)
                self.under_way.append((step + self.latency, time_ns, row))
        while self.under_way and self.under_way[0][0] <= step:
            _, self.time_ns, row = self.under_way.popleft()
            self.values[:] = row
            self.fresh = True
        if self.fresh:
            self._convert()

    def appears(self, step: int) -> bool:
        """
        Return whether a reading that was taken before appears, or all is to be forgotten.

        Parameters
        ----------
        step
            The present tick.

        """
        return step <= self.step or bool(self.under_way and self.under_way[0][0] <= step)

    @classmethod
    def axes(cls, config: SensorFile) -> tuple[tuple[str, int], ...]:
        """
        Return what is measured.

        Parameters
        ----------
        config
            Of the sensor.

        Returns
        -------
        tuple
            Keys of the file that state the errors, and their numbers of axes.

        """
        return cls.channels

    def constants(self, reading: Reading) -> Mapping[str, Any]:
        """
        Return the fields of a message that never change and that only the sensor knows.

        Parameters
        ----------
        reading
            Its topic.

        Returns
        -------
        Mapping
            Dotted name of the field -> value.

        """
        return reading.constants

    def prepare(self, reading: Reading) -> bool:
        """
        Work out what only one topic shows of a new reading.

        Parameters
        ----------
        reading
            The topic, which somebody wants.

        Returns
        -------
        bool
            Whether there is anything to show.

        """
        return True

    def compiled_constants(self) -> Sequence[float]:
        """Return what its compiled twin measures with; see plugins/src/exchange/instruments.cc."""
        return ()

    @abstractmethod
    def _measure(self, values: Array) -> bool:
        """Write the true values at this boundary; return whether there is anything to read."""

    def _convert(self) -> None:
        """Derive further numbers from a new reading."""

    # ---- save and load ---------------------------------------------------------------------

    def save_state(self) -> SavedSensor:
        """Return the present reading and those under way."""
        pending = tuple((due, time_ns, row.copy()) for due, time_ns, row in self.under_way)
        return SavedSensor(self.step, self.fresh, self.time_ns, self.values.copy(), pending)

    def load_state(self, saved: SavedSensor) -> None:
        """
        Go on from a saved state; the simulation's was loaded before.

        Parameters
        ----------
        saved
            As ``save_state`` returned it.

        """
        self.step, self.fresh, self.time_ns = saved.step, saved.fresh, saved.time_ns
        self.values[:] = saved.values
        self.under_way = deque((due, ns, row.copy()) for due, ns, row in saved.pending)
        if self.time_ns >= 0:
            self._convert()
