# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A scene: its model, vehicles, weather and schedule, validated, with every name as an id."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import mujoco

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.scene.fleet.checks import check_apart
from fluid_sim_ros.scene.fleet.compose import compose
from fluid_sim_ros.scene.fleet.fluids import check_rung
from fluid_sim_ros.scene.fleet.members import START, Fleet, prefix_of
from fluid_sim_ros.scene.fluid_models import compile_spec, force_fluid
from fluid_sim_ros.scene.gaits import Gaits
from fluid_sim_ros.scene.load_warnings import load_warnings
from fluid_sim_ros.scene.masses import scale_masses
from fluid_sim_ros.scene.media import streams_of
from fluid_sim_ros.scene.read_spec import read_spec
from fluid_sim_ros.scene.scene_files import scene_fields, scene_names
from fluid_sim_ros.scene.schedule import Schedule, check_schedule
from fluid_sim_ros.scene.vehicle import Vehicle, free_bodies, resolve
from fluid_sim_ros.scene.weather import add_waves, apply_weather
from fluid_sim_ros.schema.advised import Advised
from fluid_sim_ros.schema.data_file import kind_of
from fluid_sim_ros.schema.limits import check_limit
from fluid_sim_ros.schema.scene import Gait, Home, ScheduledEvent, VehicleFile
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.schema.waves import Waves
from fluid_sim_ros.schema.weather import CurrentModel, WindModel

_AS_STATED = RunSettings()
#: Endings of the files that MuJoCo reads as models.
_MODELS = ('.xml', '.mjcf', '.urdf', '.mjz', '.zip')


@dataclass(frozen=True)
class CompiledScene:
    """
    A MuJoCo model with the scene's names resolved to ids.

    ``streams`` names what of wind and current the scene has; ``rounded`` tells which times of the
    scene its timestep does not divide; ``warnings`` is what a user must hear of the model.
    """

    model: mujoco.MjModel
    vehicles: dict[str, Vehicle]
    schedule: Schedule
    gaits: Gaits
    streams: tuple[str, ...]
    rounded: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Scene:
    """
    A scene as its files state it; ``compile`` makes the model.

    Attributes
    ----------
    name
        Name in config/scenes, or the stem of the given file.
    model_path
        The MJCF file; of a fleet, that of its world.
    mjcf, assets
        The model itself as text, in place of the file, and the files that it names.
    fleet
        Vehicles of models of their own, in the world of ``model_path``; or None.
    description, medium, duration, keyframe, home, waves, wind, current, schedule, gait
        As in the YAML file (config/scenes); ``medium`` is ``air``, ``water`` or None (by density).
    timestep, integrator, fluid
        In place of the model's; see ``RunSettings``.
    advised
        Such settings that are known to be good enough, for whoever asks for them.
    vehicles
        Vehicle name -> how its commands map onto the model; None: every free body is a vehicle.
    masses
        Body name -> factor on its mass and inertia.

    """

    name: str
    model_path: Path
    description: str = ''
    medium: str | None = None
    duration: float = 10.0
    keyframe: str | None = None
    home: Home = field(default_factory=Home)
    waves: Waves | None = None
    wind: tuple[WindModel, ...] = ()
    current: tuple[CurrentModel, ...] = ()
    schedule: tuple[ScheduledEvent, ...] = ()
    gait: dict[str, Gait] = field(default_factory=dict)
    vehicles: dict[str, VehicleFile] | None = field(default=None)
    fleet: Fleet | None = None
    mjcf: str = ''
    assets: dict[str, bytes] = field(default_factory=dict, repr=False)
    timestep: float | None = None
    integrator: str | None = None
    fluid: str | None = None
    advised: Advised | None = None
    masses: dict[str, float] = field(default_factory=dict)

    @classmethod
    def load(cls, scene: 'str | Path | Scene') -> 'Scene':
        """
        Read a scene by name, or by the path of a scene YAML file or an MJCF file.

        Parameters
        ----------
        scene
            Name of a scene, or path of a scene YAML file or an MJCF file; a ``Scene`` is returned
            as it is.

        Returns
        -------
        Scene
            As its files state it.

        Raises
        ------
        ConfigError
            If no such scene exists, or its YAML has a fault (file, key, value, what is allowed).

        """
        if isinstance(scene, Scene):
            return scene
        path = Path(scene)
        if path.suffix in ('.yaml', '.yml'):
            return cls(**scene_fields(path))
        if path.suffix in ('.xml', '.mjcf') or path.is_file():
            if not path.is_file():
                kind = kind_of(path)
                raise ConfigError(f'{path}: {f"is {kind}, no" if kind else "no such"} MJCF file')
            if path.suffix.lower() not in _MODELS:  # MuJoCo would warn, and write a file of it
                raise ConfigError(
                    f'{path}: is no model; allowed: {listed(_MODELS)}, or a scene .yaml'
                )
            return cls(name=path.stem, model_path=path.resolve())
        if str(scene) not in scene_names():
            raise ConfigError(
                f"scene '{scene}' is not known{did_you_mean(str(scene), scene_names())} "
                f'scenes: {listed(scene_names())}; '
                'or give the path of an MJCF (.xml) or scene (.yaml) file'
            )
        by_name = config_folder() / 'scenes' / f'{scene}.yaml'
        if by_name.is_file():
            return cls(**scene_fields(by_name))
        return cls(name=str(scene), model_path=models_folder() / f'{scene}.xml')

    @property
    def settings(self) -> RunSettings:
        """The scene's own settings; ConfigError if one of them is wrong."""
        own = {key: getattr(self, key) for key in ('timestep', 'integrator', 'fluid')}
        return RunSettings.checked(f"{self.name}: key '{{}}'", **own)

    def compile(
        self,
        settings: RunSettings = _AS_STATED,
        edit: Callable[[mujoco.MjSpec], None] | None = None,
    ) -> CompiledScene:
        """
        Compile the model and resolve every name.

        Parameters
        ----------
        settings
            Of the run; what it leaves open the scene says, or else the model.
        edit
            Changes the model last, before it is compiled.

        Returns
        -------
        CompiledScene
            The model, and what the scene names in it.

        Raises
        ------
        ConfigError, ModelError
            For a wrong option, a model that does not load, or names that the model lacks.

        """
        load_plugins()
        settings = settings.over(self.settings)
        fluid, seed = settings.fluid, settings.seed
        spec, notes = self._composed(settings)
        source = self._source
        scale_masses(spec, self.masses, source)
        if settings.timestep is not None:
            spec.option.timestep = settings.timestep
        if settings.integrator_id is not None:
            spec.option.integrator = settings.integrator_id
        dry = None
        if fluid == 'none':  # wind and current still may be commanded, to no effect
            dry = streams_of(compile_spec(spec, source), self.medium)
        if fluid is not None:
            if self.fleet is not None:
                check_rung(spec, fluid, self.name)
            force_fluid(spec, fluid, source)
        if self.waves is not None and fluid in (
            None,
            'no_added_mass',
            'inflow',
        ):  # others: no surface
            add_waves(spec, self.waves.keys(seed), self.name)
        if fluid != 'none':
            apply_weather(spec, self.wind, self.current, seed, self.name)
        if edit is not None:
            edit(spec)
        model = compile_spec(spec, source)
        vehicles = self._vehicles(model)
        if self.fleet is not None:
            notes += check_apart(model, vehicles, self.name)
        check_limit('scene_events', len(self.schedule), f'{self.name}: events of the schedule')
        schedule = Schedule(self.schedule, model.opt.timestep)
        check_schedule(self.schedule, vehicles, self.name)
        gaits = Gaits(self.gait, vehicles, model.opt.timestep, self.name)
        streams = dry or streams_of(model, self.medium)
        self._check_weather(streams)
        self._check_keyframe(model)
        rounded = schedule.rounded + gaits.rounded
        loaded = load_warnings(model, every_free_body=self.vehicles is None)
        warnings = (*loaded, *notes, *rounded)
        return CompiledScene(model, vehicles, schedule, gaits, streams, rounded, warnings)

    def read_model(self) -> mujoco.MjSpec:
        """Return the model as it is written, that of a fleet composed; or raise an error."""
        return self._composed(_AS_STATED.over(self.settings))[0]

    @property
    def first_keyframe(self) -> str | None:
        """The keyframe that the scene begins at; None: as the model stands."""
        return START if self.keyframe is None and self.fleet is not None else self.keyframe

    @property
    def _source(self) -> Path:
        """What an error of the compiler names: the model, or the scene that composes one."""
        return self.model_path if self.fleet is None else Path(f'{self.name} (composed)')

    def _composed(self, settings: RunSettings) -> tuple[mujoco.MjSpec, list[str]]:
        spec = read_spec(self.model_path, self.mjcf, self.assets)
        if self.fleet is None:
            return spec, []
        stated = {key for key in ('timestep', 'integrator') if getattr(settings, key) is not None}
        return spec, compose(spec, self.fleet, self.vehicles or {}, stated, self.name)

    def _vehicles(self, model: mujoco.MjModel) -> dict[str, Vehicle]:
        files = self.vehicles
        if files is None:
            files = free_bodies(model, self.model_path)
        members = {} if self.fleet is None else self.fleet.members
        found = {}
        for name, file in files.items():
            where = f'{self.name}: vehicle {name!r}'
            if name not in members:
                found[name] = resolve(name, file, model, where)
                continue
            kind = members[name].kind
            found[name] = resolve(name, file, model, where, prefix_of(name), kind)
            if members[name].autopilot is not None and not found[name].thrusters:
                model_name = members[name].model_path.stem
                raise ConfigError(
                    f"{where}: its model '{model_name}' has no thrusters for an autopilot to "
                    "drive; leave out 'autopilot', or name them in its vehicle file"
                )
        return found

    def _check_weather(self, streams: tuple[str, ...]) -> None:
        for name, models in (('wind', self.wind), ('current', self.current)):
            if models and name not in streams:
                raise ConfigError(
                    f"{self.name}: key '{name}': the scene has no such medium; "
                    f'it has: {listed(streams)}'
                )

    def _check_keyframe(self, model: mujoco.MjModel) -> None:
        names = [model.key(i).name for i in range(model.nkey)]
        if self.keyframe is not None and self.keyframe not in names:
            raise ConfigError(
                f"{self.name}: keyframe '{self.keyframe}' is not in the model"
                f'{did_you_mean(self.keyframe, names)} it has: {listed(names)}'
            )
