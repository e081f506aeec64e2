# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors as the compiled exchange with autopilots reads them; the same bits as ``Sensor``."""

import ctypes

import numpy as np

from fluid_sim_ros.plugins.exchange import Axis, Carrier, Instrument, exchange_library
from fluid_sim_ros.sensors.beams import Looking
from fluid_sim_ros.sensors.noise import BLOCK
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation

#: Kinds in the order of ``InstrumentKind`` in plugins/src/exchange/instruments.h.
KINDS = ('imu', 'magnetometer', 'barometer', 'airspeed', 'rangefinder')


class CompiledSensor:
    """
    One sensor whose readings are made in the library, without latency.

    Parameters
    ----------
    sensor
        Gives place, rate, errors and random numbers; it is not read itself. Of ``KINDS``, due at
        whole numbers of ticks, without latency.

    Attributes
    ----------
    address
        Of its ``Instrument``.

    """

    def __init__(self, sensor: Sensor) -> None:
        self._sensor = sensor
        self._instrument = item = Instrument(
            kind=KINDS.index(sensor.config.kind), period=sensor.period, width=len(sensor.values),
            tick=-1, block=-1,
        )  # fmt: skip
        for i, axis in enumerate(sensor.errors.axes):
            item.axes[i] = Axis(*axis)
        item.position_b[:] = sensor.mount.position_b
        rotation = sensor.mount.rotation_sb
        item.turned = rotation is not None
        if rotation is not None:
            item.rotation_sb[:] = rotation.ravel()
        constants = sensor.compiled_constants()
        item.constants[: len(constants)] = constants
        if isinstance(sensor, Looking):
            item.passed = sensor.passed.ctypes.data
        self.address = ctypes.addressof(item)
        self._look = exchange_library().look

    def draw(self, tick: int) -> None:
        """
        Hand over the random numbers of the reading at a tick, and of those of the same block.

        Parameters
        ----------
        tick
            At which a reading is due.

        """
        index = tick // self._sensor.period
        self._added = self._sensor.errors.block(index // BLOCK)
        self._instrument.added = self._added.ctypes.data
        self._instrument.block = index // BLOCK

    def look(self, carrier: int, tick: int) -> bool:
        """
        Measure where a reading is due; see ``Sensor.update``.

        Parameters
        ----------
        carrier
            Address of what it sits on.
        tick
            The present one, at which all was observed with its forces.

        Returns
        -------
        bool
            Whether there is a new reading.

        """
        while (found := self._look(carrier, self.address, tick)) < 0:
            self.draw(tick)
        return found == 1

    def values(self) -> list[float]:
        """Return the present reading."""
        values: list[float] = self._instrument.values[: self._instrument.width]
        return values

    @property
    def saturated(self) -> int:
        """How many values were beyond the range so far."""
        return int(self._instrument.beyond)


def carrier_of(simulation: Simulation, vehicle: str) -> Carrier:
    """
    Return what the compiled sensors of a vehicle sit on.

    Parameters
    ----------
    simulation, vehicle
        Where it is, and its name.

    """
    rows = simulation.observe(forces=False)
    row = rows[list(simulation.vehicles).index(vehicle)]
    assert row.dtype == np.float64
    return Carrier(
        row.ctypes.data, simulation.model._address, simulation.observed._address,
        simulation.vehicle(vehicle).body_id,
    )  # fmt: skip
