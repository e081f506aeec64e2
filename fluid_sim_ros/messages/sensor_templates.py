"""CDR templates of the messages of sensors."""

from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.messages.templates import Template

#: Variance of what is not measured, for messages that cannot say so otherwise.
UNKNOWN = 1e6


def imu(frame: str, rate_variance: float, force_variance: float) -> Template:
    """
    Return sensor_msgs/Imu with blocks: angular velocity (3), linear acceleration (3).

    Without orientation, as the first number of its covariance says (-1).
    """
    return (
        Template()
        .string(frame)
        .constants([0.0, 0.0, 0.0, 1.0])
        .constants([-1.0] + [0.0] * 8)
        .doubles(3)
        .constants(_diagonal([rate_variance] * 3))
        .doubles(3)
        .constants(_diagonal([force_variance] * 3))
        .finish()
    )


def magnetic_field(frame: str, variance: float) -> Template:
    """Return sensor_msgs/MagneticField with one block: flux density (3)."""
    return Template().string(frame).doubles(3).constants(_diagonal([variance] * 3)).finish()


def fluid_pressure(frame: str, variance: float) -> Template:
    """Return sensor_msgs/FluidPressure with one block: pressure (1)."""
    return Template().string(frame).doubles(1).constants([variance]).finish()


def nav_sat_fix(frame: str, horizontal_variance: float, vertical_variance: float) -> Template:
    """Return sensor_msgs/NavSatFix with one block: latitude, longitude, altitude (3)."""
    fix, gps, diagonal_known = 0, 1, 2
    variances = [horizontal_variance, horizontal_variance, vertical_variance]
    return (
        Template()
        .string(frame)
        .number('b', fix)
        .number('H', gps)
        .doubles(3)
        .constants(_diagonal(variances))
        .number('B', diagonal_known)
        .finish()
    )


def velocity(frame: str, variance: float) -> Template:
    """
    Return geometry_msgs/TwistWithCovarianceStamped with one block: linear velocity (3).

    Its angular velocity is zero with the variance ``UNKNOWN``.
    """
    return (
        Template()
        .string(frame)
        .doubles(3)
        .constants([0.0] * 3)
        .constants(_diagonal([variance] * 3 + [UNKNOWN] * 3))
        .finish()
    )


def distance(frame: str, by_sound: bool, low: float, high: float, variance: float) -> Template:
    """Return sensor_msgs/Range of a beam without width, with one block: distance (1, float32)."""
    template = Template().string(frame).number('B', 0 if by_sound else 1)
    for value in (0.0, low, high):
        template.number('f', value)
    return template.floats(1).number('f', variance).finish()


def _diagonal(values: Sequence[float]) -> list[float]:
    numbers: list[float] = np.diag(values).ravel().tolist()
    return numbers
