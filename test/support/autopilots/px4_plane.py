# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A stand-in for PX4's fixed-wing flight: runway take-off, total energy control, loiter.

Its laws are those of PX4's documentation ("TECS", "fixed-wing attitude controller"), reduced to
what decides about climbing, and its parameters have PX4's names, so that a set of parameters can
be judged. Defaults: PX4's own, then those of the airframe 1030.
"""

import math

from test.support.autopilots.px4_pilots import Estimate, angles, clipped
from test.support.autopilots.px4_stand_in import Px4

G = 9.81
DEFAULTS = {
    'FW_AIRSPD_MIN': 10.0, 'FW_AIRSPD_TRIM': 15.0, 'FW_AIRSPD_MAX': 20.0, 'FW_TKO_AIRSPD': -1.0,
    'FW_THR_MIN': 0.0, 'FW_THR_TRIM': 0.6, 'FW_THR_MAX': 1.0, 'FW_P_LIM_MIN': -30.0,
    'FW_P_LIM_MAX': 30.0, 'FW_PSP_OFF': 0.0, 'FW_TKO_PITCH_MIN': 10.0, 'FW_T_CLMB_MAX': 5.0,
    'FW_T_CLMB_R_SP': 3.0, 'FW_T_SINK_MIN': 2.0, 'FW_T_SINK_MAX': 5.0, 'FW_T_ALT_TC': 5.0,
    'FW_T_TAS_TC': 5.0, 'FW_T_PTCH_DAMP': 0.1, 'FW_T_I_GAIN_PIT': 0.1, 'FW_T_THR_DAMPING': 0.05,
    'FW_T_THR_INTEG': 0.02, 'FW_T_VERT_ACC': 7.0, 'FW_T_RLL2THR': 15.0, 'FW_P_TC': 0.4,
    'FW_R_TC': 0.4, 'TRIM_PITCH': 0.0, 'MIS_TAKEOFF_ALT': 30.0,
}  # fmt: skip
AIRFRAME_1030 = {
    'FW_PR_P': 0.9, 'FW_PR_FF': 0.5, 'FW_PR_I': 0.5, 'TRIM_PITCH': -0.15, 'FW_PSP_OFF': 2.0,
    'FW_P_LIM_MIN': -15.0, 'FW_RR_FF': 0.5, 'FW_RR_P': 0.3, 'FW_RR_I': 0.5, 'FW_THR_MAX': 0.6,
    'FW_THR_MIN': 0.05, 'FW_THR_TRIM': 0.25, 'FW_T_CLMB_MAX': 8.0, 'FW_T_SINK_MAX': 2.7,
    'FW_T_SINK_MIN': 2.2,
}  # fmt: skip


class Energy:
    """Total energy control: pitch trades speed for height, throttle brings in both."""

    def __init__(self, parameters: dict[str, float]) -> None:
        self.p = parameters
        self.pitch_sum = self.throttle_sum = 0.0
        self.pitch = 0.0
        self.throttle = parameters['FW_THR_MAX']

    def step(self, dt, height_error, climb, speed, speed_rate, bank, least_pitch):
        p = self.p
        gain, loss = p['FW_T_CLMB_MAX'] * G, -p['FW_T_SINK_MIN'] * G
        asked_climb = min(
            max(height_error / p['FW_T_ALT_TC'], -p['FW_T_SINK_MAX']), p['FW_T_CLMB_R_SP']
        )
        asked_rate = (p['FW_AIRSPD_TRIM'] - speed) / p['FW_T_TAS_TC']
        asked_rate = min(max(asked_rate, 0.5 * loss / speed), 0.5 * gain / speed)
        height, motion = asked_climb * G, speed * asked_rate
        # balance: height less motion, by pitch
        error = (height - climb * G) - (motion - speed * speed_rate)
        limits = math.radians(max(least_pitch, p['FW_P_LIM_MIN'])), math.radians(p['FW_P_LIM_MAX'])
        self.pitch_sum += dt * p['FW_T_I_GAIN_PIT'] * error / (speed * G)
        self.pitch_sum = clipped(self.pitch_sum, 0.5)
        asked = (height - motion + p['FW_T_PTCH_DAMP'] * error) / (speed * G) + self.pitch_sum
        change = dt * p['FW_T_VERT_ACC'] / speed
        asked = min(max(asked, self.pitch - change), self.pitch + change)
        self.pitch = min(max(asked, limits[0]), limits[1])
        # sum: height and motion, by throttle
        total = height + motion + p['FW_T_RLL2THR'] * (1 / math.cos(bank) - 1)
        total = min(max(total, loss), gain)
        error = total - climb * G - speed * speed_rate
        share = total / gain * (p['FW_THR_MAX'] - p['FW_THR_TRIM'])
        if total < 0:
            share = -total / loss * (p['FW_THR_TRIM'] - p['FW_THR_MIN'])
        asked = p['FW_THR_TRIM'] + share + p['FW_T_THR_DAMPING'] * error / (gain - loss)
        asked += self.throttle_sum
        self.throttle = min(max(asked, p['FW_THR_MIN']), p['FW_THR_MAX'])
        if self.throttle == asked:  # not at a limit
            self.throttle_sum += dt * p['FW_T_THR_INTEG'] * error / (gain - loss)
        return self.pitch, self.throttle


class FixedWing:
    """Takes off, climbs to 30 m and loiters there; outputs as in 1030."""

    def __init__(self, parameters: dict[str, float]) -> None:
        self.p = {**DEFAULTS, **AIRFRAME_1030, **parameters}
        self.energy = Energy(self.p)
        self.estimate = Estimate()
        self.sums = [0.0, 0.0]  # of pitch and roll
        self.rate, self.speed, self.time = 0.0, 0.0, 0.0
        self.flies = False
        self.start: float | None = None

    def controls(self, px4: Px4, sensors: dict) -> list[float]:
        state, p = self.estimate, self.p
        state.update(px4, sensors)
        now, dt = sensors['time_usec'] * 1e-6, 0.004
        self.start = -state.position[2] if self.start is None else self.start
        height, climb = -state.position[2] - self.start, -state.velocity[2]
        speed = max(math.hypot(*state.velocity), 3.0)
        self.rate += dt * (((speed - self.speed) / dt if self.speed else 0.0) - self.rate)
        self.speed, self.time = speed, now
        roll, pitch, yaw = angles(state.quat)
        take_off = p['FW_TKO_AIRSPD'] if p['FW_TKO_AIRSPD'] > 0 else p['FW_AIRSPD_MIN']
        self.flies |= speed > take_off
        bank, rudder = 0.0, 0.0
        if not self.flies:
            asked, throttle = 0.0, 1.0
            off = math.remainder(math.pi / 2 - yaw, math.tau)
            rudder = clipped(0.8 * off - 0.3 * state.rates[2], 1)
        else:
            climbing = height < 20.0
            least = p['FW_TKO_PITCH_MIN'] if climbing else -90.0
            bank = 0.0 if climbing else 0.35
            asked, throttle = self.energy.step(
                dt, p['MIS_TAKEOFF_ALT'] - height, climb, speed, self.rate, bank, least
            )
        return self._outputs(roll, pitch, asked, bank, throttle, rudder, dt)

    def _outputs(self, roll, pitch, asked, bank, throttle, rudder, dt):
        p, rates = self.p, self.estimate.rates
        scale = p['FW_AIRSPD_TRIM'] / max(self.speed, p['FW_AIRSPD_MIN'])
        asked += math.radians(p['FW_PSP_OFF'])
        turns = []
        for i, (error, rate, names, time_constant) in enumerate((
            (asked - pitch, rates[1], 'FW_PR_{}', p['FW_P_TC']),
            (bank - roll, rates[0], 'FW_RR_{}', p['FW_R_TC']),
        )):  # fmt: skip
            wanted = clipped(error / time_constant, 1.0)
            lack = wanted - rate
            self.sums[i] = clipped(self.sums[i] + dt * p[names.format('I')] * lack, 0.4)
            turns.append(
                scale * p[names.format('FF')] * wanted
                + scale**2 * (p[names.format('P')] * lack + self.sums[i])
            )
        outputs = [0.0] * 16
        outputs[2], outputs[4] = rudder, throttle
        aileron = clipped(turns[1], 1)
        outputs[3], outputs[6] = -aileron, aileron
        outputs[7] = clipped(turns[0] + p['TRIM_PITCH'], 1)
        return outputs
