# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors of a new vehicle: the shipped preset of each kind, by name."""

from typing import Any, Literal, get_args

import yaml

SensorKind = Literal[
    'imu', 'magnetometer', 'barometer', 'pressure', 'gnss', 'airspeed', 'dvl', 'rangefinder'
]
KINDS: tuple[str, ...] = get_args(SensorKind)
#: Kind -> preset of config/sensors, and readings per second [Hz] as the shipped vehicles have.
_PRESETS: dict[str, tuple[str, float]] = {
    'imu': ('icm20948', 100), 'magnetometer': ('ak09916', 50), 'barometer': ('bmp388', 50),
    'pressure': ('ms5837_30ba', 50), 'gnss': ('neo_m8n', 10), 'airspeed': ('ms4525do', 50),
    'dvl': ('a50', 5), 'rangefinder': ('tfmini_s', 50),
}  # fmt: skip


def sensor_entries(kinds: list[str], site: str = 'imu') -> dict[str, Any]:
    """
    Return what a vehicle file says of sensors.

    Parameters
    ----------
    kinds
        Of `KINDS`.
    site
        Where those sit that measure along their own axes.

    Returns
    -------
    dict
        Kind -> preset and rate [Hz].

    """
    entries: dict[str, Any] = {}
    for kind in kinds:
        preset, rate = _PRESETS[kind]
        entries[kind] = {'preset': preset, 'rate': rate}
        if kind in ('imu', 'magnetometer'):
            entries[kind]['site'] = site
    return entries


def sensor_lines(entries: dict[str, Any]) -> str:
    """
    Return the lines of a vehicle file about its sensors; nothing without any.

    Parameters
    ----------
    entries
        Of `sensor_entries`, or as the user wrote them.

    Returns
    -------
    str
        YAML with a line end, or ''.

    """
    if not entries:
        return ''
    lines = ['sensors:  # presets: config/sensors']
    for kind, entry in entries.items():
        text = yaml.safe_dump(entry, default_flow_style=True, sort_keys=False, width=10_000)
        lines.append(f'  {kind}: {text.strip()}')
    return '\n'.join(lines) + '\n'
