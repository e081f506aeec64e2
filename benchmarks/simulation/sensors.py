# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Noise of the sensors against its parameters, and what reading them costs.

Allan deviation (overlapping, IEEE Std 952-2020, annex C) of a resting IMU against the curve of its
parameters; cost of each sensor's update as a ratio to the steps between two readings, within one
run. Draws the picture of doc/sensors.md.
Run: ``python -m benchmarks.simulation.sensors [--quick] [--json PATH]``.
"""

from typing import Any

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from benchmarks.common import RESULTS, ROOT, arguments, wall_seconds, write
from fluid_sim_ros import Simulation
from fluid_sim_ros.schema.sensors import Channel
from fluid_sim_ros.sensors import SensorSuite

Array = NDArray[np.float64]
SCENES = ('x500', 'rov', 'aerosonde')
BLOCK = 50  # readings that are timed at once


def resting_readings(count: int) -> tuple[Array, SensorSuite]:
    """Return readings of the x500's IMU in one state, shape (count, 6), and its suite."""
    simulation = Simulation('x500')
    suite = SensorSuite(simulation, 'x500')
    suite.update()
    imu = suite.imu
    assert imu is not None
    readings = np.empty((count, 6))
    for k in range(count):
        imu.update((k + 1) * imu.period, 0)
        readings[k] = imu.values
    return readings, suite


def allan_deviation(readings: Array, sizes: Array) -> Array:
    """Return the overlapping Allan deviation over axes, for averages of ``sizes`` readings."""
    total = np.cumsum(np.vstack([np.zeros(readings.shape[1]), readings]), axis=0)
    found = []
    for n in sizes:
        means = (total[n:] - total[:-n]) / n
        found.append(np.sqrt(0.5 * np.mean((means[n:] - means[:-n]) ** 2)))
    return np.array(found)


def expected_deviation(channel: Channel, rate: float, tau: Array) -> Array:
    """Return what the parameters say: white noise with rounding, and the bias walk."""
    return np.sqrt(channel.variance(rate) / (rate * tau) + channel.bias_walk**2 * tau / 3)


def noise(count: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the comparison, and what the picture needs."""
    readings, suite = resting_readings(count)
    imu = suite.imu
    assert imu is not None
    rate = float(imu.config.rate)
    sizes = np.unique(np.geomspace(1, count / 30, 25).astype(int))
    tau = sizes / rate
    curves, result = {}, {}
    for name, axes, channel in (
        ('gyroscope', readings[:, 3:], imu.config.gyroscope),
        ('accelerometer', readings[:, :3], imu.config.accelerometer),
    ):
        measured = allan_deviation(axes, sizes)
        expected = expected_deviation(channel, rate, tau)
        curves[name] = (measured, expected, channel)
        result[name] = {
            'averaging_s': tau.tolist(), 'measured': measured.tolist(),
            'expected': expected.tolist(),
            'largest_error': float(np.abs(measured / expected - 1).max()),
        }  # fmt: skip
        print(f'{name}: Allan deviation off by at most {result[name]["largest_error"]:.1%}')
    return result, {'tau': tau, 'curves': curves, 'readings': readings, 'rate': rate}


def cost(scene: str, blocks: int) -> dict[str, float]:
    """Return each sensor's update in units of the bare steps of 10 ms, medians over blocks."""
    simulation = Simulation(scene)
    suite = SensorSuite(simulation, next(iter(simulation.vehicles)))
    steps = round(0.01 / simulation.timestep)
    bare: list[float] = []
    observing: list[float] = []
    reading: dict[str, list[float]] = {s.config.kind: [] for s in suite.sensors}
    tick = 0
    for _ in range(blocks):
        bare.append(wall_seconds(lambda: [simulation.step(steps) for _ in range(BLOCK)]))
        observing.append(
            wall_seconds(lambda: [simulation.observe(forces=True) for _ in range(BLOCK)])
        )
        for sensor in suite.sensors:
            ticks = [tick + k * sensor.period for k in range(BLOCK)]

            def read(sensor: Any = sensor, ticks: list[int] = ticks) -> None:
                for each in ticks:
                    sensor.update(each, 0)

            reading[sensor.config.kind].append(wall_seconds(read))
        tick += BLOCK * max(sensor.period for sensor in suite.sensors)
        simulation.reset()
    step = float(np.median(bare))
    ratios = {'observe': float(np.median(observing)) / step}
    ratios |= {kind: float(np.median(times)) / step for kind, times in reading.items()}
    print(f'{scene}: steps of 10 ms: 1, ' + ', '.join(f'{k} {v:.2f}' for k, v in ratios.items()))
    return ratios


def draw(seen: dict[str, Any]) -> None:
    """Draw the Allan deviation, and readings at rest."""
    mpl.use('Agg')
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout='constrained')
    units = {'gyroscope': 'rad/s', 'accelerometer': 'm/s²'}
    for (name, (measured, expected, channel)), colour in zip(
        seen['curves'].items(), ('C0', 'C1'), strict=True
    ):
        left.loglog(
            seen['tau'], measured, 'o', ms=4, color=colour, label=f'{name} [{units[name]}]'
        )
        left.loglog(seen['tau'], expected, '-', lw=1, color=colour)
        left.loglog(seen['tau'], channel.density / np.sqrt(seen['tau']), ':', color=colour)
        walk = channel.bias_walk * np.sqrt(seen['tau'] / 3)
        left.loglog(seen['tau'], walk, '--', lw=1, color=colour)
    left.set_ylim(bottom=3e-6)
    left.set_xlabel('averaging time [s]')
    left.set_ylabel('Allan deviation')
    left.plot([], [], 'k-', lw=1, label='of the parameters')
    left.plot([], [], 'k:', label='white noise N/√τ')
    left.plot([], [], 'k--', lw=1, label='bias walk K√(τ/3)')
    left.legend(fontsize=8)
    left.grid(alpha=0.3)
    shown = 100
    time = np.arange(shown) / seen['rate']
    right.step(time, 1e3 * seen['readings'][:shown, 3], where='post', lw=1)
    right.axhline(0, color='k', lw=0.8)
    right.set_xlabel('time [s]')
    right.set_ylabel('angular velocity about x [10⁻³ rad/s]')
    right.set_title('A resting ICM-20948 in counts of 1.06·10⁻³ rad/s', fontsize=10)
    right.grid(alpha=0.3)
    path = ROOT / 'doc' / 'img' / 'sensors_noise.png'
    figure.savefig(path, dpi=110)
    print(f'wrote {path}')


def main() -> None:
    """Measure and write."""
    options = arguments(__doc__, 'sensors')
    count, blocks = (50_000, 10) if options.quick else (1_000_000, 60)
    deviations, seen = noise(count)
    costs = {scene: cost(scene, blocks) for scene in SCENES}
    write(options.json, {'readings': count, 'allan_deviation': deviations, 'cost': costs})
    if options.json.parent == RESULTS and not options.quick:
        draw(seen)


if __name__ == '__main__':
    main()
