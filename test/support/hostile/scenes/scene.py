# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whole scene files, of one model and of fleets, with the files of weather that they name."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, get_args

import numpy as np
import yaml

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.plugins.config import medium_of
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.fleet import FleetFile, FleetVehicle
from fluid_sim_ros.schema.mean_flow import Steady
from fluid_sim_ros.schema.scene import BodyWrench, Gait, SceneFile, ScheduledEvent, VehicleFile
from fluid_sim_ros.schema.sensors import CameraFile
from fluid_sim_ros.schema.settings import FLUID_RUNGS
from fluid_sim_ros.schema.weather import CurrentModel, WindModel
from fluid_sim_ros.schema.yaml_file import read_yaml
from fluid_sim_ros.simulation import Simulation
from test.support.hostile.models.draw import Draw
from test.support.hostile.scenes.draw_schema import ABSENT, SchemaDraw
from test.support.hostile.scenes.rules import RULES

#: Scenes whose models are taken: in air, in water, through the surface; with joints and without.
SOURCES = (
    'sphere', 'x500', 'aerosonde', 'bluerov2_heavy', 'remus100', 'fish', 'swimmer', 'wave_buoy',
    'buoyant_sphere', 'amphibious',
)  # fmt: skip
#: Keys that are not drawn: an autopilot would be waited for, the medium follows from the model,
#: what a fleet's vehicles do has tests of its own; the others name parts of a model.
NOT_DRAWN = {
    'SceneFile.medium', 'FleetFile.medium', 'FleetFile.gait', 'FleetFile.schedule',
    'FleetVehicle.autopilot', 'FleetVehicle.keyframe', 'FleetFile.world', 'GridFile.data',
    'SensorFile.preset', 'SensorFile.site', 'VehicleFile.thrusters', 'VehicleFile.joints',
}  # fmt: skip
FLEET_SHARE = 0.15
#: Of the vehicles whose sensors are stated: a camera draws pictures, which takes its time.
CAMERA_SHARE = 0.1


@dataclass(frozen=True)
class Source:
    """A model, its vehicle, keyframes, surface; and by fluid whether it feels wind, current."""

    model: str
    vehicle: str
    body: str
    thrusters: tuple[str, ...]
    joints: tuple[str, ...]
    keyframes: tuple[str, ...]
    streams: dict[str, tuple[str, ...]]
    surface: bool


def _loads(scene: Scene) -> bool:
    try:
        scene.compile()
    except FluidSimError:
        return False
    return True


def _feels(scene: Scene, rung: str, stream: str) -> bool:
    """Return whether a scene with some fluid has the medium of wind or current."""
    flow = (Steady(model='steady', velocity=[1.0, 0.0, 0.0]),)
    flows = {'wind': (), 'current': ()} | {stream: flow}
    return _loads(replace(scene, schedule=(), waves=None, fluid=rung or scene.fluid, **flows))


@cache
def source(name: str) -> Source:
    """Return what a scene of the package has."""
    simulation = Simulation(name)
    try:
        vehicle, target = next(iter(simulation.vehicles.items()))
        model = simulation.model
        stated = read_yaml(config_folder() / 'scenes' / f'{name}.yaml')
        medium = medium_of(model)
        scene = simulation.scene
        streams = {
            rung: tuple(each for each in ('wind', 'current') if _feels(scene, rung, each))
            for rung in ('', *FLUID_RUNGS)
            if not rung or _loads(replace(scene, fluid=rung))
        }
        keys = tuple(filter(None, (model.key(i).name for i in range(model.nkey))))
        return Source(
            stated['model'], vehicle, model.body(target.body_id).name,
            target.thrusters, target.joints, keys, streams,
            medium is not None and bool(medium.text('surface')),
        )  # fmt: skip
    finally:
        simulation.close()


def _groups(union: Any) -> dict[str, str]:
    """Return, by the name of each model of weather, what only one of them may be."""
    return {
        get_args(one.model_fields['model'].annotation)[0]: one.one_of
        for one in get_args(get_args(union)[0])
    }


class _SceneDraw:
    def __init__(self, seed: int) -> None:
        self.draw = draw = Draw(f'scene {seed}')
        self.source = source(draw.choice(SOURCES))
        # the fluid decides which streams there are, and what is stated of the vehicle what moves
        self.rung = draw.choice(list(self.source.streams)) if draw.yes(0.4) else ''
        self.streams = self.source.streams[self.rung]
        self.stated = draw.yes(0.7)
        self.drawn = SchemaDraw(draw, RULES | {
            'ModelKeys.model': lambda draw, _: self.source.model,
            'ModelKeys.vehicles': lambda draw, _: self.vehicles(),
            'ModelKeys.keyframe': lambda draw, _: (
                draw.choice(self.source.keyframes) if self.source.keyframes else ABSENT
            ),
            'VehicleFile.body': lambda draw, _: self.source.body,
            'VehicleFile': lambda draw, found: found | {
                'thrusters': list(self.source.thrusters), 'joints': list(self.source.joints)
            },
            'VehicleFile.thrusters': lambda draw, _: ABSENT,
            'VehicleFile.joints': lambda draw, _: ABSENT,
            'SensorsFile.camera': lambda draw, _: (
                self.drawn.mapping(CameraFile) if draw.yes(CAMERA_SHARE) else ABSENT
            ),
            'SceneKeys.fluid': lambda draw, _: ABSENT,
            'SceneKeys.medium': lambda draw, _: ABSENT,
            'SensorsFile': self.sensors,
            'ScheduledEvent.wind': lambda draw, _: self.flow('wind'),
            'ScheduledEvent.current': lambda draw, _: self.flow('current'),
            'SceneKeys.schedule': lambda draw, _: self.schedule(),
            'SceneKeys.gait': lambda draw, _: self.gait(),
            'ScheduledEvent.at': lambda draw, _: draw.choice((0.0, 0.01, draw.uniform(0, 0.2))),
            'ScheduledEvent.thrust': lambda draw, _: self.thrust(),
            'ScheduledEvent.wrench': lambda draw, _: {
                self.name: self.drawn.mapping(BodyWrench)
            },
            'ScheduledEvent': self.event,
            'FleetFile.vehicles': lambda draw, _: self.fleet(),
            'FleetFile.world': lambda draw, _: ABSENT,
            'FleetFile.gait': lambda draw, _: ABSENT,
            'FleetFile.schedule': lambda draw, _: ABSENT,
            'FleetVehicle': self.fleet_vehicle,
            'FleetVehicle.model': lambda draw, _: self.source.model,
            'FleetVehicle.vehicle': lambda draw, _: self.drawn.mapping(VehicleFile),
            'FleetVehicle.keyframe': lambda draw, _: ABSENT,
            'FleetVehicle.autopilot': lambda draw, _: ABSENT,
        })  # fmt: skip
        self.name = self.source.vehicle

    def content(self) -> dict[str, Any]:
        if self.draw.yes(FLEET_SHARE):
            content = self.drawn.mapping(FleetFile)
        else:
            # what is stated of the vehicles decides what the others may name
            stated = {'vehicles': self.vehicles()} if self.stated else {}
            content = self.drawn.mapping(SceneFile, 'vehicles') | stated
            self.drawn.keys |= {f'SceneFile.{key}' for key in stated}
        for stream, union in (('wind', WindModel), ('current', CurrentModel)):
            if stream in content and stream not in self.streams:
                del content[stream]
            if stream in content:
                content[stream] = self.single(content[stream], _groups(union))
        if self.rung or not self.source.surface:
            content.pop('waves', None)
        if self.rung:
            content['fluid'] = self.rung
            self.drawn.keys |= {'SceneFile.fluid', 'FleetFile.fluid'}
        return content

    def sensors(self, draw: Draw, found: Mapping[str, Any]) -> dict[str, Any]:
        """Leave out what measures a medium that the scene may not have."""
        dry = {'airspeed', 'barometer'} if 'wind' not in self.streams else set()
        wet = {'pressure', 'sonar'} if 'current' not in self.streams else set()
        return {key: value for key, value in found.items() if key not in dry | wet}

    def flow(self, stream: str) -> Any:
        if stream not in self.streams:
            return ABSENT
        return [self.draw.gauss(0, 3), self.draw.gauss(0, 3), self.draw.choice((0.0, 0.1))]

    def vehicles(self) -> dict[str, Any]:
        self.name = self.draw.choice((self.source.vehicle, 'a', 'Z_9'))
        return {self.name: self.drawn.mapping(VehicleFile)}

    def single(self, models: list[dict[str, Any]], groups: Mapping[str, str]) -> Any:
        found, taken = [], set()
        curl = any(model.get('rotational') for model in models)
        for model in models:
            if curl:  # either of them is the rotation of the flow
                model.pop('span', None)
            group = groups[model['model']]
            if group not in taken:
                found.append(model)
                taken |= {group} - {''}
        return found[0] if len(found) == 1 and self.draw.yes() else found

    def thrust(self) -> Any:
        if not (self.source.thrusters and self.stated):
            return ABSENT
        return {self.name: [self.draw.signed(5.0) for _ in self.source.thrusters]}

    def schedule(self) -> list[dict[str, Any]]:
        count = self.draw.choice((0, 1, 3, 30))
        return [self.drawn.mapping(ScheduledEvent) for _ in range(count)]

    def event(self, draw: Draw, found: Mapping[str, Any]) -> dict[str, Any]:
        if found.keys() & {'wind', 'current', 'thrust', 'wrench'}:
            return dict(found)
        return dict(found) | {'wrench': {self.name: {}}}

    def gait(self) -> Any:
        count = len(self.source.joints)
        if not (count and self.stated):
            return ABSENT
        gait = self.drawn.mapping(Gait) | {
            key: [self.draw.gauss(0, 0.3) for _ in range(count)]
            for key in ('amplitudes', 'phases')
        }
        if 'offsets' in gait:
            gait['offsets'] = [self.draw.gauss(0, 0.1) for _ in range(count)]
        return {self.name: gait | {'rate': self.draw.choice((50.0, 100.0))}}

    def fleet(self) -> dict[str, Any]:
        count = self.draw.choice((1, 2, 3))
        fleet = {f'v{i}': self.drawn.mapping(FleetVehicle) for i in range(count)}
        for i, vehicle in enumerate(fleet.values()):
            vehicle['position'] = [
                60.0 * i,
                0.0,
                *([self.draw.uniform(1, 9)] if self.draw.yes() else []),
            ]
        return fleet

    def fleet_vehicle(self, draw: Draw, found: Mapping[str, Any]) -> dict[str, Any]:
        kept = {key: found[key] for key in found.keys() - {'count', 'spacing'}}
        return kept | ({'count': draw.randrange(1, 4), 'spacing': 8.0} if draw.yes(0.3) else {})


def drawn_content(seed: int) -> tuple[dict[str, Any], set[str]]:
    """
    Return what the scene file of a seed says.

    Parameters
    ----------
    seed
        A whole number.

    Returns
    -------
    content, keys
        As YAML holds it, and which keys of which schemas it has, as ``Schema.key``.

    """
    scene = _SceneDraw(seed)
    content = scene.content()
    return content, scene.drawn.keys


def drawn_scene(seed: int, folder: Path) -> tuple[Path, set[str]]:
    """
    Write the scene of a seed, and the files that it may name.

    Parameters
    ----------
    seed
        A whole number.
    folder
        Where they go.

    Returns
    -------
    path, keys
        The scene's file, and which keys of which schemas it has, as ``Schema.key``.

    """
    content, keys = drawn_content(seed)
    path = folder / 'drawn.yaml'
    path.write_text(yaml.safe_dump(content, allow_unicode=True), encoding='utf-8')
    (folder / 'series.csv').write_text('t,x,y,z\n0,1,0,0\n0.5,0,1,0\n2,0,0,-1\n')
    random = np.random.default_rng(seed)
    np.savez(
        folder / 'grid.npz', t=[0.0, 1.0], x=[-5.0, 0.0, 5.0], y=[-5.0, 5.0], z=[-9.0, 9.0],
        **{component: random.normal(size=(2, 3, 2, 2)) for component in 'uvw'},
    )  # fmt: skip
    return path, keys
