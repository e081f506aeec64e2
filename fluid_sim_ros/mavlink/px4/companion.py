# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The second link to PX4: what its simulator module takes no message for, and its parameters.

PX4's start script opens a MAVLink link for a payload's computer (px4-rc.mavlink: it listens on
UDP 14280 + instance and speaks to 14030 + instance). There it takes BATTERY_STATUS of another
component of its own system for one of its batteries, and says what its parameters are.
"""

import math
import socket
from collections.abc import Sequence
from contextlib import suppress
from ipaddress import ip_address

from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.parameter_check import ParameterCheck, bytewise_value
from fluid_sim_ros.mavlink.program.parameters import needed_parameters

#: Where the first instance listens, and where it speaks to (UDP).
PX4_PORT, OUR_PORT = 14280, 14030
#: Exchanges between two BATTERY_STATUS: 10 Hz.
_EXCHANGES = 25
#: Largest MAV_SYS_ID of PX4.
_LARGEST_SYSTEM = 250
#: MAV_COMP_ID_BATTERY, MAV_BATTERY_FUNCTION_ALL, MAV_BATTERY_TYPE_LIPO
_BATTERY, _ALL, _LIPO = 180, 1, 1
#: No reading of temperature [cdegC], of energy, and of a cell or pack [mV].
_NO_TEMPERATURE, _NO_ENERGY, _NO_CELL = 32767, -1, 65535
_CELLS = 10  # that BATTERY_STATUS has fields for


class Companion:
    """
    Speaks to one PX4 beside the simulator's link.

    Nothing is waited for, and nobody need be there.

    Parameters
    ----------
    options
        Which PX4.
    file
        Its mapping: with a battery or not, and the parameters.
    limits
        Largest thrust of each thruster [N].

    """

    def __init__(
        self, options: AutopilotOptions, file: AutopilotFile, limits: Sequence[float]
    ) -> None:
        self._port = PX4_PORT + options.instance
        self._own = OUR_PORT + options.instance
        system = options.instance + 1  # MAV_SYS_ID, as the start script sets it
        self._known = system <= _LARGEST_SYSTEM
        self._mav = dialect.MAVLink(
            None, srcSystem=min(system, _LARGEST_SYSTEM), srcComponent=_BATTERY
        )
        self._socket: socket.socket | None = None
        self._battery = Battery(file.battery, limits) if file.battery else None
        self._draws = 0
        self._told = False
        self._check = ParameterCheck(
            'PX4', needed_parameters(file, options.parameters), system, self._link,
            bytewise_value, f'UDP port {self._port}',
        )  # fmt: skip

    def open(self, host: str) -> None:
        """
        Speak to the PX4 of a host from now on.

        Parameters
        ----------
        host
            Its address.

        """
        self._disconnect()
        if not self._known:
            return
        family = socket.AF_INET6 if ':' in host else socket.AF_INET
        link = socket.socket(family, socket.SOCK_DGRAM)
        with suppress(OSError):  # another program is the payload there: answers go to that one
            link.bind((host if ip_address(host).is_loopback else '', self._own))
        link.connect((host, self._port))
        link.setblocking(False)
        self._socket = link
        self._check.start()

    def begin(self) -> None:
        """Have a full battery, as where a flight begins anew."""
        if self._battery is not None:
            self._battery.refill()

    def draw(self, thrusts: Sequence[float], seconds: float) -> None:
        """
        Use the battery, if there is one, and say now and then what it has.

        Parameters
        ----------
        thrusts
            Of all thrusters [N].
        seconds
            Since the last call: one exchange.

        """
        if self._battery is None:
            return
        self._battery.draw(thrusts, seconds)
        self.tell()

    @property
    def battery(self) -> Battery | None:
        """What its battery monitor measures, or None."""
        return self._battery

    def tell(self) -> None:
        """Say now and then what the battery has, which the caller has drawn on."""
        if self._battery is None:
            return
        self._draws += 1
        if self._socket is not None and self._draws % _EXCHANGES == 0:
            message = battery_status(self._battery)
            self._mav.seq = (self._mav.seq + 1) % 256
            with suppress(OSError):  # nobody listens yet
                self._socket.send(message.pack(self._mav))

    def lines(self) -> dict[str, str]:
        """Return once how PX4 is set otherwise than its mapping states; see the check."""
        if self._known or self._told:
            return self._check.lines()
        self._told = True
        return {
            'unread': f'instance {self._port - PX4_PORT} has no MAVLink system of its own '
            f'(they end at {_LARGEST_SYSTEM}): no battery, and parameters are not compared'
        }

    def close(self) -> None:
        """Close the link."""
        self._check.stop()
        self._disconnect()

    def _disconnect(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def _link(self) -> socket.socket:
        """Return the link for somebody who waits for answers; it is his to close."""
        if self._socket is None:
            raise ConnectionError('not open')
        return self._socket.dup()


def battery_status(battery: Battery) -> dialect.MAVLink_battery_status_message:
    """
    Return BATTERY_STATUS of a pack whose cells are not measured one by one.

    Parameters
    ----------
    battery
        As it is now.

    Returns
    -------
    message
        Its voltage in the first field, and what does not fit there in the next one, as
        https://mavlink.io/en/messages/common.html#BATTERY_STATUS has it.

    """
    left = round(1e3 * battery.voltage)
    cells: list[int] = []
    while not cells or left:
        cells.append(min(left, _NO_CELL - 1))
        left -= cells[-1]
    cells += [_NO_CELL] * (_CELLS - len(cells))
    return dialect.MAVLink_battery_status_message(
        id=0, battery_function=_ALL, type=_LIPO, temperature=_NO_TEMPERATURE, voltages=cells,
        current_battery=min(round(1e2 * battery.current), 32767),
        current_consumed=round(1e3 * battery.used), energy_consumed=_NO_ENERGY,
        battery_remaining=math.ceil(1e2 * battery.left),
    )  # fmt: skip
