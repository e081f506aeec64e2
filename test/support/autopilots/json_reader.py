# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ArduPilot's reader of JSON states, as strict as the real one is naive (libraries/SITL/SIM_JSON).

It looks for each key as plain text from the start of the line (or of its section), takes what
stands two characters behind it, and knows no spaces.
"""

import re

_NUMBER = r'-?\d+(?:\.\d+)?(?:e[-+]\d+)?'
#: section, key, how many numbers, required
KEYS = (
    ('', 'timestamp', 1, True),
    ('imu', 'gyro', 3, True),
    ('imu', 'accel_body', 3, True),
    ('', 'position', 3, True),
    ('', 'attitude', 3, False),
    ('', 'quaternion', 4, False),
    ('', 'velocity', 3, True),
    ('', 'velocity_wind', 3, False),
    ('', 'airspeed', 1, False),
    ('', 'rng_1', 1, False),
    ('windvane', 'direction', 1, False),
    ('windvane', 'speed', 1, False),
    *(('rc', f'rc_{i}', 1, False) for i in range(1, 13)),
    ('battery', 'voltage', 1, False),
    ('battery', 'current', 1, False),
)


class JsonReader:
    """
    Reads replies; time must go on.

    ``clock_us`` is ArduPilot's clock, as whole microseconds: it adds the difference of timestamps
    in floating point, and drops what is less than one.
    """

    def __init__(self) -> None:
        self.time = -1.0
        self.clock_us = 0

    def read(self, data: bytes) -> dict[str, list[float]]:
        text = data.decode('ascii')
        assert text[0] == '\n' and text[-1] == '\n' and text.count('\n') == 2
        assert ' ' not in text
        found = {}
        for section, key, count, required in KEYS:
            found_section = text.find(section) if section else 0
            start = found_section + len(section) + 1
            at = text.find(key, start) if found_section >= 0 else -1
            if at < 0:
                assert not required, f'{key} is missing'
                continue
            behind = text[at + len(key) :]
            assert behind.startswith('":'), f'{key} is found inside another key: {behind[:9]}'
            numbers = ','.join([f'({_NUMBER})'] * count)
            match = re.match(rf'\[{numbers}\]' if count > 1 else numbers, behind[2:])
            assert match, f'{key}: {behind[2:60]}'
            found[key] = [float(number) for number in match.groups()]
        assert 'attitude' in found or 'quaternion' in found
        assert found['timestamp'][0] > self.time, 'time must go on'
        passed = found['timestamp'][0] - max(self.time, 0.0)
        self.clock_us = int(float(self.clock_us) + passed * 1e6)
        self.time = found['timestamp'][0]
        return found
