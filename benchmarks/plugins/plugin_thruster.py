# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
fluid_sim.thruster against exact answers: step response, bollard thrust, order, cost.

Step response: the rotor of an x500 against the exponential, for five integrators and timesteps
from 0.1 ms to 1 s. Bollard thrust and dead zone of the T200 against Blue Robotics' sheets. Order
of convergence with RK4 for a propeller on a slide, against SciPy. Cost: one step of a body with
eight thrusters over one with eight stock motors with the same lag, timed in turns in one run.
Run: ``python -m benchmarks.plugins.plugin_thruster [--quick] [--json PATH]``.
"""

import time
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.physics.propulsion import lagged_speed, propeller_load
from fluid_sim_ros.physics.t200 import SUPPLIES
from test.support.plugin_models import Array, config, load
from test.support.thruster_models import AEROSONDE, T200, X500, read, rotor_world, settle

INTEGRATORS = ('Euler', 'RK4', 'implicit', 'implicitfast', 'discrete')
STEPS = (1e-4, 1e-3, 0.01, 0.1, 1.0)
ORDER_STEPS = (0.12, 0.08, 0.06, 0.04, 0.03)


def option(integrator: str, step: float) -> str:
    """Return the <option> of a model without gravity."""
    return f'timestep="{step!r}" integrator="{integrator}" gravity="0 0 0"'


def step_response() -> dict[str, Any]:
    """Return the largest error of the speed [rad/s] by integrator and timestep."""
    errors: dict[str, list[float]] = {}
    up, down = X500['time_constant']
    for integrator in INTEGRATORS:
        errors[integrator] = []
        for step in STEPS:
            worst = 0.0
            for start, command in ((0, 500), (800, 300), (700, -400)):
                values = {**X500, 'rad_s_max': [1000, 1000]}
                model, data = load(rotor_world(values, option=option(integrator, step)))
                data.act[0], data.ctrl[0] = start, command
                for i in range(1, 21):
                    mujoco.mj_step(model, data)
                    exact = lagged_speed(start, command, i * step, up, down)
                    worst = max(worst, abs(read(model, data)['rad_s'] - float(exact)))
            errors[integrator].append(worst)
    return {'timestep': list(STEPS), 'error_rad_s': errors}


def bollard() -> dict[str, Any]:
    """Return thrust at full command by voltage, the sheet's, and the dead zone's edges."""
    rows = []
    for voltage, supply in SUPPLIES.items():
        model, data = load(rotor_world({**T200, 'voltage': voltage}))
        forward, reverse = (settle(model, data, pulse)['thrust'] for pulse in (1900, 1100))
        inside = [settle(model, data, edge)['thrust'] for edge in supply[2:]]
        outside = [
            settle(model, data, edge + side)['thrust']
            for edge, side in zip(supply[2:], (-1e-3, 1e-3), strict=True)
        ]
        rows.append({
            'voltage': voltage, 'forward': forward, 'reverse': reverse,
            'error': max(forward / supply.forward, -reverse / supply.reverse) - 1,
            'dead_zone_exact': inside == [0, 0] and outside[0] < 0 < outside[1],
        })  # fmt: skip
    return {'rows': rows}


def order() -> dict[str, Any]:
    """Return the error of a propeller on a slide after 0.96 s by timestep, and the order."""
    constants = {
        'density': AEROSONDE['density'], 'diameter': AEROSONDE['diameter'],
        'thrust': AEROSONDE['thrust_coefficients'],
    }  # fmt: skip

    def rates(now: float, y: Array) -> list[float]:
        omega = lagged_speed(200, 600, now, 0.3, 0.5)
        return [y[1], float(propeller_load(omega, y[1], **constants)[0]) / 0.5]

    exact = solve_ivp(rates, (0, 0.96), [0, 2.0], rtol=1e-12, atol=1e-12).y[:, -1]
    body = (
        '<joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass=".5" diaginertia="1 1 1"/>'
    )
    values = {**AEROSONDE, 'time_constant': [0.3, 0.5]}
    errors = []
    for step in ORDER_STEPS:
        model, data = load(rotor_world(values, body=body, option=option('RK4', step)))
        data.act[0], data.ctrl[0], data.qvel[0] = 200, 600, 2
        mujoco.mj_step(model, data, round(0.96 / step))
        errors.append(float(abs(data.qpos[0] - exact[0]) + abs(data.qvel[0] - exact[1])))
    slope = float(np.polyfit(np.log(ORDER_STEPS), np.log(errors), 1)[0])
    return {'timestep': list(ORDER_STEPS), 'error': errors, 'order': slope}


def eight(integrator: str, *, plugin: bool) -> str:
    """Return a free body with eight thrusters: T200 with lag, or motors with MuJoCo's filter."""
    sites, actuators, instances = '', '', ''
    for i in range(8):
        sites += f'<site name="s{i}" pos="{0.1 * np.cos(i):.3f} {0.1 * np.sin(i):.3f} 0"/>'
        if plugin:
            values = {**T200, 'time_constant': 0.1, 'command': 'newton'}
            instances += f'<instance name="t{i}">{config(values)}</instance>'
            actuators += (
                f'<plugin plugin="fluid_sim.thruster" instance="t{i}" site="s{i}" '
                'gear="1 0 0 0 0 0" actdim="2"/>'
            )
        else:
            actuators += (
                f'<general site="s{i}" gear="1 0 0 0 0 0" dyntype="filterexact" dynprm="0.1"/>'
            )
    extension = (
        f'<extension><plugin plugin="fluid_sim.thruster">{instances}</plugin></extension>'
        if plugin
        else ''
    )
    return f"""<mujoco><option {option(integrator, 0.002)}/>{extension}<worldbody>
<body><freejoint/><inertial pos="0 0 0" mass="11" diaginertia=".2 .3 .3"/>{sites}</body>
</worldbody><actuator>{actuators}</actuator></mujoco>"""


def cost(*, quick: bool) -> dict[str, Any]:
    """Return microseconds a step with eight thrusters and with eight motors, and their ratio."""
    result: dict[str, Any] = {}
    steps, rounds = (2000, 5) if quick else (10000, 15)
    for integrator in ('implicitfast', 'RK4'):
        both = [load(eight(integrator, plugin=plugin)) for plugin in (False, True)]
        for _, data in both:
            data.ctrl[:] = 5
        times: list[list[float]] = [[], []]
        for _ in range(rounds):
            for (model, data), kept in zip(both, times, strict=True):
                begin = time.perf_counter()
                mujoco.mj_step(model, data, steps)
                kept.append((time.perf_counter() - begin) / steps * 1e6)
        stock, ours = (float(np.median(kept)) for kept in times)
        result[integrator] = {'stock_us': stock, 'plugin_us': ours, 'ratio': ours / stock}
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw step responses, T200 curves, the four quadrants and the order."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(10, 7.5), layout='constrained')
    (lag, bollard_axes), (quadrants, order_axes) = axes
    times = np.linspace(0, 0.16, 400)
    up, down = X500['time_constant']
    for step, marker in ((0.002, '.'), (0.02, 'o')):
        values = {**X500, 'rad_s_max': [1000, 1000]}
        model, data = load(rotor_world(values, option=option('implicitfast', step)))
        shown = []
        while data.time < 0.1599:
            data.ctrl[0] = 600 if data.time < 0.0799 else -300
            mujoco.mj_step(model, data)
            shown.append((data.time, read(model, data)['rad_s']))
        lag.plot(*np.array(shown).T, marker, ms=4, label=f'plugin, h = {step * 1e3:g} ms')
    top = float(lagged_speed(0, 600, 0.08, up, down))
    exact = np.where(
        times < 0.08, lagged_speed(0, 600, times, up, down),
        lagged_speed(top, -300, np.maximum(times - 0.08, 0), up, down),
    )  # fmt: skip
    lag.plot(times, exact, 'k', lw=0.8, label='exact')
    lag.set(xlabel='t [s]', ylabel='rotor speed [rad/s]', title='step response, x500 rotor')
    lag.legend()
    pulses = np.linspace(1100, 1900, 401)
    for voltage in SUPPLIES:
        model, data = load(rotor_world({**T200, 'voltage': voltage}))
        thrust = [settle(model, data, pulse)['thrust'] for pulse in pulses]
        bollard_axes.plot(pulses, thrust, label=f'{voltage:g} V')
        supply = SUPPLIES[voltage]
        bollard_axes.plot([1100, 1900], [-supply.reverse, supply.forward], 'k+')
    bollard_axes.set(
        xlabel='pulse width [us]', ylabel='thrust [N]', title='T200 at rest (+ sheet)'
    )
    bollard_axes.legend()
    inflow = np.linspace(-40, 40, 161)
    for speed in (-600, -300, 0, 300, 600):
        thrust_now, _ = propeller_load(
            speed, inflow, density=AEROSONDE['density'], diameter=AEROSONDE['diameter'],
            thrust=AEROSONDE['thrust_coefficients'],
        )  # fmt: skip
        quadrants.plot(inflow, thrust_now, label=f'{speed} rad/s')
    quadrants.set(xlabel='inflow [m/s]', ylabel='thrust [N]', title='four quadrants, Aerosonde')
    quadrants.legend()
    measured = result['order']
    order_axes.loglog(measured['timestep'], measured['error'], 'o-', label='RK4')
    guide = np.array(measured['timestep'])
    order_axes.loglog(
        guide, measured['error'][-1] * (guide / guide[-1]) ** 4, 'k--', label='order 4'
    )
    order_axes.set(
        xlabel='timestep [s]', ylabel='error [m] + [m/s]',
        title=f'propeller on a slide with lag: order {measured["order"]:.2f}',
    )  # fmt: skip
    order_axes.legend()
    figure.savefig(RESULTS / 'plugin_thruster.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_thruster')
    result = {
        'step_response': step_response(),
        'bollard': bollard(),
        'order': order(),
        'cost_eight_thrusters': cost(quick=options.quick),
    }
    worst = max(max(values) for values in result['step_response']['error_rad_s'].values())
    print(f'step response: worst error {worst:.1e} rad/s')
    for row in result['bollard']['rows']:
        print(f"{row['voltage']:4g} V: {row['forward']:.1f} {row['reverse']:.1f} N, "
              f"dead zone exact: {row['dead_zone_exact']}")  # fmt: skip
    print(f'order with RK4: {result["order"]["order"]:.2f}')
    for integrator, row in result['cost_eight_thrusters'].items():
        print(f"{integrator}: {row['stock_us']:.2f} -> {row['plugin_us']:.2f} us, "
              f"ratio {row['ratio']:.2f}")  # fmt: skip
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
