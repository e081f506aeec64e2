# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The topics of a vehicle's sensors: each new reading as one message, when it appears."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.messages.sensor_messages import UNKNOWN, layout_of
from fluid_sim_ros.messages.templates import StampBytes, Template
from fluid_sim_ros.messages.topic import SENSOR, StateTopic
from fluid_sim_ros.schema.sensors import Channel
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.reading import Reading
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation


class SensorTopic(StateTopic):
    """
    A topic that shows a sensor's readings.

    Its stamp is the time at which the reading was true, so with latency it lies in the past. A
    sensor may have several topics, and is sampled only while one of them is asked for.

    Parameters
    ----------
    simulation
        What is measured.
    sensor
        By what.
    reading
        Which of its topics.
    vehicle
        Name of the vehicle.
    former
        Under the name that the topic had in the last release.

    """

    always = False

    def __init__(
        self,
        simulation: Simulation,
        sensor: Sensor,
        reading: Reading,
        vehicle: str,
        former: bool = False,
    ) -> None:
        self._simulation, self._sensor, self._reading = simulation, sensor, reading
        self._stamp = StampBytes()
        sources = _sources(sensor, reading)
        template = Template.of(reading.message, _constants(sensor, reading), list(sources))
        self._singles: list[tuple[NDArray[Any], NDArray[Any]]] = []
        copies = [(template.stamps[0], self._stamp.view)]
        pairs = zip(sources.values(), template.blocks, strict=True)
        copies += template.copies([self._as_wide(numbers, len(b)) for numbers, b in pairs])
        name = f'{vehicle}/{reading.topic}'
        super().__init__(
            f'{vehicle}/{reading.former}' if former else name, reading.message, template,
            math.gcd(sensor.period, sensor.latency), copies, sensor.needs_forces,
            self._narrow if self._singles else None, SENSOR, appears_later=sensor.latency > 0,
            new_name=name if former else '',
        )  # fmt: skip

    def _as_wide(self, numbers: NDArray[Any], size: int) -> NDArray[Any]:
        """Return an array of as many bytes: in single precision where the message has that."""
        if size == numbers.nbytes:
            return numbers
        single = np.zeros(numbers.shape, np.float32)
        self._singles.append((single, numbers))
        return single

    def _narrow(self) -> None:
        for single, numbers in self._singles:
            single[:] = numbers

    def ready(self) -> bool:
        """Return whether a new reading has appeared; its numbers are made then."""
        sensor = self._sensor
        sensor.update(self._simulation.tick, self._simulation.time_ns)
        if not (sensor.fresh and sensor.prepare(self._reading)):
            return False
        self._stamp.set(sensor.time_ns)
        return super().ready()


def sensor_topics(simulation: Simulation, suite: SensorSuite, vehicle: str) -> list[SensorTopic]:
    """
    Return the topics of a vehicle's sensors.

    Parameters
    ----------
    simulation
        What is measured.
    suite
        The vehicle's sensors.
    vehicle
        Its name.

    Returns
    -------
    list of SensorTopic
        In the order of the schema, then those under former names.

    """
    pairs = [(sensor, reading) for sensor in suite.sensors for reading in sensor.readings]
    topics = [SensorTopic(simulation, *pair, vehicle) for pair in pairs]
    topics += [SensorTopic(simulation, *pair, vehicle, True) for pair in pairs if pair[1].former]
    return topics


def _sources(sensor: Sensor, reading: Reading) -> dict[str, NDArray[Any]]:
    """Return the numbers that each member of a message follows."""
    sources: dict[str, NDArray[Any]] = {}
    layout = layout_of(reading.message)
    for quantity, members in zip(reading.quantities, layout.quantities, strict=True):
        numbers = getattr(sensor, quantity.name)
        for i, member in enumerate(members):
            sources[member] = numbers if len(members) == 1 else numbers[i : i + 1]
    return sources


def _constants(sensor: Sensor, reading: Reading) -> dict[str, Any]:
    """Return what stays in a message: its frame, and the variances of the sensor's errors."""
    layout = layout_of(reading.message)
    constants: dict[str, Any] = {
        'header.frame_id': reading.frame or sensor.frame, **layout.constants,
        **sensor.constants(reading),
    }  # fmt: skip
    for quantity, member in zip(reading.quantities, layout.variances, strict=True):
        channels: list[Channel] = [getattr(sensor.config, key) for key in quantity.channels]
        variances = [channel.variance(sensor.config.rate) for channel in channels]
        if len(variances) == 1:
            variances *= getattr(sensor, quantity.name).size
        if not member:
            pass  # this message cannot say it
        elif layout.size == 1:
            (constants[member],) = variances
        else:
            variances += [UNKNOWN] * (layout.size - len(variances))
            constants[member] = np.diag(variances).ravel()
        if layout.limits:
            limits = channels[0].range or (0.0, math.inf)
            constants |= zip(layout.limits, limits, strict=True)
    return constants
