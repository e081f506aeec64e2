# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the types of the schemas do not say: rules between keys, files, names, orders."""

from collections.abc import Mapping
from typing import Any

from fluid_sim_ros.schema.flow_signals import TIDES
from fluid_sim_ros.schema.sensors import presets
from fluid_sim_ros.schema.settings import FLUID_RUNGS, INTEGRATORS
from test.support.hostile.models.draw import Draw
from test.support.hostile.scenes.draw_schema import ABSENT, Rule

Found = Mapping[str, Any]


def _text(draw: Draw, _: Found) -> str:
    return draw.choice(('', 'of a test', 'with: a colon, "quotes" and # a sign', '\u00e9\u4e2d'))


def _rising(draw: Draw, count: int) -> list[float]:
    values, last = [], draw.gauss(0, 1)
    for _ in range(count):
        last += draw.size(1e-3, 10)
        values.append(last)
    return values


def _limits(low: float, high: float) -> Rule:
    def rule(draw: Draw, _: Found) -> list[float]:
        return sorted((draw.uniform(low, high), draw.uniform(low, high)))

    return rule


def _stratified(draw: Draw, found: Found) -> dict[str, Any]:
    count = draw.randrange(2, 6)
    depths = _rising(draw, count)
    return dict(found) | {
        'depths': depths, 'factors': [draw.zero_or_size(0.01, 2) for _ in depths]
    }  # fmt: skip


def _series(draw: Draw, found: Found) -> dict[str, Any]:
    times = _rising(draw, draw.randrange(2, 6))
    rows = [[draw.gauss(0, 1) for _ in range(3)] for _ in times]
    if draw.yes():
        return {'model': 'series', 'file': 'series.csv'}
    return {'model': 'series', 'times': times, 'velocities': rows}


def _turbulence(draw: Draw, found: Found) -> dict[str, Any]:
    kept = dict(found)
    for one, other in (('wind_6m', 'sigma'), ('height', 'length')):
        kept.pop(one, None), kept.pop(other, None)
    three = [draw.size(0.1, 5) for _ in range(3)]
    kept |= {'wind_6m': draw.size(0.1, 20)} if draw.yes() else {'sigma': three}
    lengths = {'length': [draw.size(1, 500) for _ in range(3)]}
    kept |= {'height': draw.size(1, 1000)} if draw.yes() else lengths
    if 'length' in kept:
        kept.pop('follow_vehicle', None)
    return kept | {'airspeed': draw.size(1, 50), 'direction': [1.0, draw.gauss(0, 1), 0.0]}


def _waves(draw: Draw, found: Found) -> dict[str, Any]:
    kept = dict(found)
    period = draw.size(1, 20)
    # below a fiftieth of the length in deep water, by which no wave breaks
    kept |= {'period': period, 'height': draw.choice((0.0, draw.size(1e-3, 0.03) * period**2))}
    if 'depth' in kept:
        kept['depth'] = 10 * kept['height'] + draw.size(20, 500)
    if 'repeat' in kept:
        kept['repeat'] = draw.size(2e3, 1e4)
    if kept['model'] == 'regular':
        kept = {key: kept[key] for key in kept.keys() - _RANDOM_SEA}
    if 'components' in kept:
        kept['components'] = draw.randrange(1, 60)
    return kept


_RANDOM_SEA = {'gamma', 'spreading', 'components', 'repeat', 'cutoff', 'seed'}


def _constituent(draw: Draw, found: Found) -> dict[str, Any]:
    kept = {key: found[key] for key in found.keys() - {'name', 'period_hours'}}
    period = (
        {'name': draw.choice(list(TIDES))} if draw.yes() else {'period_hours': draw.size(1, 30)}
    )
    return kept | period


def _preset(kind: str) -> Rule:
    return lambda draw, found: (
        draw.choice(presets(kind)) if presets(kind) and draw.yes() else ABSENT
    )


def _camera(draw: Draw, found: Found) -> dict[str, Any]:
    # what is drawn costs a picture at each reading
    kept = dict(found) | {'width': draw.randrange(1, 40), 'height': draw.randrange(1, 40)}
    if not kept.get('color', True):
        kept['depth'] = True
    return kept | {'rate': draw.choice((10.0, 50.0))}


RULES: dict[str, Rule] = {
    **{f'{schema}.{key}': _text for schema, key in (
        ('SceneKeys', 'description'), ('SensorFile', 'source'), ('VehicleFile', 'source'),
        ('Advised', 'command'), ('Advised', 'metric'),
    )},
    **{f'{schema}.integrator': lambda draw, _: draw.choice(list(INTEGRATORS))
       for schema in ('SceneKeys', 'Advised')},
    **{f'{schema}.fluid': lambda draw, _: draw.choice(FLUID_RUNGS)
       for schema in ('SceneKeys', 'Advised')},
    **{f'{schema}.timestep': lambda draw, _: draw.choice((0.001, 0.002, 0.004, 0.005, 1 / 240))
       for schema in ('SceneKeys', 'Advised')},
    'SceneKeys.duration': lambda draw, _: draw.size(0.02, 0.3),
    'SensorFile.rate': lambda draw, _: draw.choice((1.0, 10.0, 33.0, 100.0, 200.0)),
    'SensorFile.latency': lambda draw, _: draw.choice((0.0, 1e-3, 0.02, 0.1)),
    'SensorFile.site': lambda draw, _: ABSENT,
    'SensorFile.preset': lambda draw, _: ABSENT,
    **{f'{schema}.preset': _preset(kind) for schema, kind in (
        ('ImuFile', 'imu'), ('MagnetometerFile', 'magnetometer'), ('BarometerFile', 'barometer'),
        ('PressureFile', 'pressure'), ('GnssFile', 'gnss'), ('DvlFile', 'dvl'),
        ('LidarFile', 'lidar'), ('SonarFile', 'sonar'), ('AirspeedFile', 'airspeed'),
        ('RangefinderFile', 'rangefinder'), ('CameraFile', 'camera'),
    )},
    'Channel.range': _limits(-1e6, 1e6),
    'ScanFile.angles': _limits(-180.0, 180.0),
    'ScanFile.beams': lambda draw, _: draw.randrange(2, 50),
    'CameraFile.depth_range': _limits(0.01, 1000.0),
    'CameraFile.frame': lambda draw, _: draw.choice(('a_optical_frame', 'B2_x_optical_frame')),
    'CameraFile': _camera,
    'Waves.direction': lambda draw, _: [draw.choice((1.0, -1.0, 0.3)), draw.gauss(0, 1)],
    'Waves': _waves,
    'Stratified': _stratified,
    'Series.file': lambda draw, _: ABSENT,
    'Series.times': lambda draw, _: ABSENT,
    'Series': _series,
    'GridFile.file': lambda draw, _: 'grid.npz',
    'GridFile.data': lambda draw, _: ABSENT,
    'GridFile': lambda draw, found: dict(found) | {'file': 'grid.npz'},
    'Logarithmic.roughness': lambda draw, _: draw.size(1e-4, 1),
    'Logarithmic.reference_height': lambda draw, _: draw.size(2, 20),
    'Turbulence': _turbulence,
    'Turbulence.tick': lambda draw, _: draw.choice((0.01, 0.002, 0.1)),
    'GaussMarkov.tick': lambda draw, _: draw.choice((0.1, 0.01, 0.002)),
    'GaussMarkov.time_constant': lambda draw, _: draw.size(0.1, 100),
    'Constituent.name': lambda draw, _: ABSENT,
    'Constituent': _constituent,
    'Home.year': lambda draw, _: draw.uniform(2025, 2029.9),
}  # fmt: skip
