# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The YAML schema of ``sensors:`` in config/vehicles, and of the presets in config/sensors.

A sensor without errors stated is exact: each error is off until a number switches it on.
"""

from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Strict, Vector
from fluid_sim_ros.schema.yaml_file import read_yaml

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
        """
        Return the variance of a reading: white noise and rounding, not the bias.

        Parameters
        ----------
        rate
            Readings per second [Hz].

        Returns
        -------
        float
            [u^2].

        """
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
        Readings per second of simulated time [Hz], at most the step rate; each at the nearest.
    latency
        Time from what is measured to the reading [s]; rounded to whole timesteps, and said so.
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
        known, preset = presets(cls.kind), content['preset']
        if not isinstance(preset, str):
            raise ValueError(f'preset: must be a name; presets: {listed(known)}')
        if preset not in known:
            raise ValueError(
                f"preset '{preset}' is not known{did_you_mean(preset, known)} "
                f'presets: {listed(known)}'
            )
        path = config_folder() / 'sensors' / cls.kind / f'{preset}.yaml'
        return {**read_yaml(path), **content}


def presets(kind: str) -> list[str]:
    """
    Return the names of the presets of a kind of sensor, sorted.

    Parameters
    ----------
    kind
        Such as ``imu``.

    """
    return sorted(path.stem for path in (config_folder() / 'sensors' / kind).glob('*.yaml'))


class ImuFile(SensorFile):
    """Accelerometer [m/s^2] and gyroscope [rad/s]."""

    kind = 'imu'
    accelerometer: Channel = Channel()
    gyroscope: Channel = Channel()


class MagnetometerFile(SensorFile):
    """Magnetic flux density [T]."""

    kind = 'magnetometer'
    field: Channel = Channel()


class BarometerFile(SensorFile):
    """Static pressure [Pa], for altitude."""

    kind = 'barometer'
    pressure: Channel = Channel()


class PressureFile(SensorFile):
    """Absolute pressure of the water [Pa], for depth."""

    kind = 'pressure'
    pressure: Channel = Channel()


class GnssFile(SensorFile):
    """Position of the antenna, east and north, and up [m], and its velocity [m/s]."""

    kind = 'gnss'
    horizontal: Channel = Channel()
    vertical: Channel = Channel()
    velocity: Channel = Channel()


class AirspeedFile(SensorFile):
    """Differential pressure of a pitot tube along x of its axes [Pa]."""

    kind = 'airspeed'
    pressure: Channel = Channel()


class RangefinderFile(SensorFile):
    """Distance along ``direction`` of its axes [m]; beyond the range it is infinite."""

    kind = 'rangefinder'
    distance: Channel = Channel()
    direction: Vector = [0.0, 0.0, -1.0]


class DvlFile(SensorFile):
    """
    Doppler velocity log: velocity over the bed [m/s] by four beams, and height over it [m].

    The beams point down (-z of its axes), tilted by ``beam_angle`` [deg] towards the four corners;
    ``altitude.range`` bounds the height of bottom lock.
    """

    kind = 'dvl'
    velocity: Channel = Channel()
    altitude: Channel = Channel()
    beam_angle: Annotated[Number, Field(ge=0, lt=90)] = 22.5


class ScanFile(SensorFile):
    """
    Distances along a fan of beams in the x-y plane of its axes [m]; beyond the range infinite.

    ``angles`` [deg] are those of the first and the last of the ``beams``, from x counter-clockwise
    about z.
    """

    kind = 'scan'
    distance: Channel = Channel()
    beams: Annotated[int, Field(ge=2, le=4096)] = 360
    angles: Limits = [-180.0, 180.0]

    @model_validator(mode='after')
    def _angles_are_ordered(self) -> 'ScanFile':
        low, high = self.angles
        if not -360.0 <= low < high <= 360.0:
            raise ValueError('angles: the first must be below the second, both within 360 deg')
        return self


class LidarFile(ScanFile):
    """Distances by light [m], in a fan of beams."""

    kind = 'lidar'


class SonarFile(ScanFile):
    """
    Distances by sound in water [m], in a fan of beams.

    ``loss`` is the transmission loss there and back at which an echo is no longer heard [dB],
    ``frequency`` that of the sound [Hz]; ``temperature`` [degC], ``salinity`` [g/kg] and ``depth``
    [m] are those of the water that absorbs it.
    """

    kind = 'sonar'
    beams: Annotated[int, Field(ge=2, le=4096)] = 64
    angles: Limits = [-60.0, 60.0]
    loss: Positive = 110.0
    frequency: Annotated[Number, Field(ge=100, le=1e6)] = 2e5
    temperature: Annotated[Number, Field(ge=-6, le=35)] = 10.0
    salinity: Annotated[Number, Field(ge=0, le=50)] = 35.0
    depth: Annotated[Number, Field(ge=0, le=7000)] = 0.0


class CameraFile(SensorFile):
    """
    Pictures of a pinhole camera that looks along x of its axes, with z up in the picture.

    ``width`` and ``height`` are in pixels, ``field_of_view`` is the angle across the width [deg].
    ``color`` and ``depth`` say which pictures there are; depths are distances along x, infinite
    beyond ``depth_range`` [m]. ``frame`` is the name of its optical frame (REP-103).
    """

    kind = 'camera'
    width: Annotated[int, Field(ge=1, le=4096)] = 640
    height: Annotated[int, Field(ge=1, le=4096)] = 480
    field_of_view: Annotated[Number, Field(ge=1, le=170)] = 60.0
    color: bool = True
    depth: bool = False
    depth_range: Limits = [0.1, 20.0]
    frame: Annotated[str, Field(pattern=r'^[A-Za-z][A-Za-z0-9_]*_optical_frame$')] = (
        'camera_optical_frame'
    )

    @model_validator(mode='after')
    def _shows_something(self) -> 'CameraFile':
        if not (self.color or self.depth):
            raise ValueError('color, depth: one of them must be true')
        low, high = self.depth_range
        if not 0.01 <= low < high <= 1000.0:
            raise ValueError('depth_range: must rise, within 0.01 and 1000 m')
        return self


class SensorsFile(Strict):
    """
    The sensors of a vehicle.

    ``dither`` adds uniform noise within one quantum either way to every reading of the IMU, the
    magnetometer, the barometer and the pressure sensor: autopilots take a constant reading for a
    dead sensor.
    """

    imu: ImuFile | None = None
    magnetometer: MagnetometerFile | None = None
    barometer: BarometerFile | None = None
    pressure: PressureFile | None = None
    gnss: GnssFile | None = None
    airspeed: AirspeedFile | None = None
    rangefinder: RangefinderFile | None = None
    dvl: DvlFile | None = None
    lidar: LidarFile | None = None
    sonar: SonarFile | None = None
    camera: CameraFile | None = None
    dither: bool = False


#: The sensors that a vehicle may have: the keys of ``sensors:`` but for its settings.
KINDS = tuple(key for key in SensorsFile.model_fields if key != 'dither')
