# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given
from scipy.integrate import solve_ivp

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.drag import blunt_slender_drag, viscous_resistance
from fluid_sim_ros.physics.inertia_box import inertia_box_drag, inertia_box_viscous
from fluid_sim_ros.physics.reynolds import (
    reynolds_number,
    terminal_speed_combined,
    terminal_speed_quadratic,
    terminal_speed_stokes,
)
from test.support.strategies import floats


def test_reynolds_number():
    # 0.1 m sphere at 1 m/s in water of 1e-3 Pa s.
    assert reynolds_number(-1.0, 0.1, 1000.0, 1e-3) == pytest.approx(1e5, rel=1e-15)


def test_no_viscosity_is_refused():
    with pytest.raises(ConfigError, match='viscosity'):
        reynolds_number(1.0, 1.0, 1.0, 0.0)


@given(floats(-100, 100), floats(1e-4, 1), floats(1e-3, 2), floats(1, 2000), floats(1e-6, 10))
def test_forces_balance_at_each_terminal_speed(weight, radius, area, density, viscosity):
    v = terminal_speed_combined(weight, radius, area, density, viscosity)
    resistance = 6 * np.pi * viscosity * radius * v + density * area * abs(v) * v
    assert resistance == pytest.approx(weight, rel=1e-12)
    v = terminal_speed_stokes(weight, radius, viscosity)
    assert 6 * np.pi * viscosity * radius * v == pytest.approx(weight, rel=1e-13)
    v = terminal_speed_quadratic(weight, area, density)
    assert density * area * abs(v) * v == pytest.approx(weight, rel=1e-13)
    assert abs(terminal_speed_combined(weight, radius, area, density, viscosity)) <= min(
        abs(v), abs(terminal_speed_stokes(weight, radius, viscosity))
    ) * (1 + 1e-12)


def test_limits_of_the_combined_speed():
    assert terminal_speed_combined(2.0, 0.1, 0.0, 0.0, 0.5) == pytest.approx(
        float(terminal_speed_stokes(2.0, 0.1, 0.5)), rel=1e-15
    )
    assert terminal_speed_combined(2.0, 0.1, 0.3, 5.0, 0.0) == pytest.approx(
        float(terminal_speed_quadratic(2.0, 0.3, 5.0)), rel=1e-15
    )
    assert terminal_speed_combined(0.0, 0.1, 0.3, 5.0, 0.0) == 0
    with pytest.raises(ConfigError, match='resistance'):
        terminal_speed_combined(1.0, 0.1, 0.0, 1.0, 0.0)


def test_terminal_speeds_balance_the_models():
    r, rho, beta = 0.05, 1.2, 1.8e-5
    v = float(terminal_speed_combined(0.3, r, 0.5 * np.pi * r**2, rho, beta))
    drag = blunt_slender_drag([r] * 3, [v, 0, 0], density=rho, c_blunt=0.5, c_slender=0.25)
    viscous = viscous_resistance([r] * 3, [v, 0, 0], np.zeros(3), beta)[0]
    assert -(drag + viscous)[0] == pytest.approx(0.3, rel=1e-13)
    box = [0.1, 0.2, 0.3]
    v = float(terminal_speed_combined(0.3, 0.2, 2 * 0.2 * 0.3, rho, beta))
    total = (
        inertia_box_drag(box, [v, 0, 0], np.zeros(3), rho)[0]
        + inertia_box_viscous(box, [v, 0, 0], np.zeros(3), beta)[0]
    )
    assert -total[0] == pytest.approx(0.3, rel=1e-13)


def test_quadratic_fall_follows_the_hyperbolic_tangent():
    # m v' = W - rho K v^2: v = vt tanh(t/tau), tau = m vt / W.
    mass, weight, rho, r = 2.0, 3.0, 1000.0, 0.02
    vt = float(terminal_speed_quadratic(weight, 0.5 * np.pi * r**2, rho))
    tau = mass * vt / weight

    def fall(_, v):
        drag = blunt_slender_drag([r] * 3, [v[0], 0, 0], density=rho, c_blunt=0.5, c_slender=0)
        return [(weight + drag[0]) / mass]

    found = solve_ivp(fall, (0, 2 * tau), [0.0], rtol=1e-11, atol=1e-12).y[0, -1]
    assert found == pytest.approx(vt * np.tanh(2), rel=1e-9)


def test_stokes_fall_is_exponential():
    # v = vt (1 - exp(-t/tau)), tau = m/(6 pi beta r); vt = 2 drho g r^2/(9 beta) for a sphere.
    r, beta, drho, mass, g = 1e-3, 0.1, 500.0, 3e-6, 9.81
    weight = drho * g * 4 / 3 * np.pi * r**3
    vt = float(terminal_speed_stokes(weight, r, beta))
    assert vt == pytest.approx(2 * drho * g * r**2 / (9 * beta), rel=1e-14)
    tau = mass / (6 * np.pi * beta * r)

    def fall(_, v):
        return [
            (weight + viscous_resistance([r] * 3, [v[0], 0, 0], np.zeros(3), beta)[0][0]) / mass
        ]

    found = solve_ivp(fall, (0, tau), [0.0], rtol=1e-11, atol=1e-14).y[0, -1]
    assert found == pytest.approx(vt * (1 - np.exp(-1)), rel=1e-9)
