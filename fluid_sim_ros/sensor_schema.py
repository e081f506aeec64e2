"""
The YAML schema of ``sensors:`` in config/vehicles, and of the presets in config/sensors.

A sensor without errors stated is exact: each error is off until a number switches it on.
"""

from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from fluid_sim_ros.errors import listed
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema import NotNegative, Number, Positive, Strict, read_yaml

Limits = Annotated[list[Number], Field(min_length=2, max_length=2)]


class Channel(Strict):
    """
    Errors of one measured quantity of unit u, the same on each of its axes.

    Attributes
    ----------
    density
        White noise as root of its two-sided spectral density (the angle or velocity random walk
        of an inertial sensor) [u/sqrt(Hz)]; its deviation is density x sqrt(rate).
    deviation
        White noise as standard deviation of a reading [u]; adds to that of ``density``.
    bias_walk
        Random walk of the bias, which begins at 0: after t its variance is bias_walk^2 t
        [u/sqrt(s)].
    resolution
        Readings are whole multiples of it [u]; 0: not quantised.
    range
        Lowest and highest reading [u]: beyond, the sensor saturates and counts it.

    """

    density: NotNegative = 0.0
    deviation: NotNegative = 0.0
    bias_walk: NotNegative = 0.0
    resolution: NotNegative = 0.0
    range: Limits | None = None

    @model_validator(mode='after')
    def _range_is_ordered(self) -> 'Channel':
        if self.range is not None and not self.range[0] < self.range[1]:
            raise ValueError('range: the first number must be below the second')
        return self

    def variance(self, rate: float) -> float:
        """Return the variance of a reading [u^2]: white noise and rounding, not the bias."""
        return self.density**2 * rate + self.deviation**2 + self.resolution**2 / 12.0


class SensorFile(Strict):
    """
    What every sensor has.

    Attributes
    ----------
    preset
        File of config/sensors/<kind> with values for what is not stated here.
    site
        Site of the base body where it sits and along whose axes it measures; default: base_link.
    rate
        Readings per second of simulated time [Hz]; must divide the step rate.
    latency
        Time from what is measured to the reading [s]; a whole number of timesteps.
    source
        Where the numbers come from.

    """

    kind: ClassVar[str]

    preset: Annotated[str, Field(exclude=True)] = ''
    site: str | None = None
    rate: Positive
    latency: NotNegative = 0.0
    source: str = ''

    @model_validator(mode='before')
    @classmethod
    def _fill_from_preset(cls, content: Any) -> Any:
        if not isinstance(content, dict) or not content.get('preset'):
            return content
        known = presets(cls.kind)
        if content['preset'] not in known:
            raise ValueError(
                f"preset '{content['preset']}' is not known; presets: {listed(known)}"
            )
        path = config_folder() / 'sensors' / cls.kind / f'{content["preset"]}.yaml'
        return {**read_yaml(path), **content}


def presets(kind: str) -> list[str]:
    """Return the names of the presets of a kind of sensor, sorted."""
    return sorted(path.stem for path in (config_folder() / 'sensors' / kind).glob('*.yaml'))


class ImuFile(SensorFile):
    """Accelerometer [m/s^2] and gyroscope [rad/s]."""

    kind = 'imu'
    accelerometer: Channel = Channel()
    gyroscope: Channel = Channel()


class SensorsFile(Strict):
    """
    The sensors of a vehicle.

    ``dither`` adds uniform noise within one quantum either way to every reading of the IMU,
    the magnetometer and the barometer, so that no two readings are the same: autopilots take a
    constant reading for a dead sensor.
    """

    imu: ImuFile | None = None
    dither: bool = False
