"""A scene: an MJCF model and its YAML file, validated, with every name resolved to an id once."""

from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, ModelError, listed
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.scene.fluid_models import compile_spec, force_fluid
from fluid_sim_ros.scene.gaits import Gaits
from fluid_sim_ros.scene.masses import scale_masses
from fluid_sim_ros.scene.media import streams_of
from fluid_sim_ros.scene.schedule import Schedule
from fluid_sim_ros.scene.vehicle import Vehicle, free_bodies, resolve
from fluid_sim_ros.scene.weather import apply_weather
from fluid_sim_ros.scene.weather_files import with_files
from fluid_sim_ros.schema.advised import Advised
from fluid_sim_ros.schema.base import parse, read_yaml
from fluid_sim_ros.schema.scene import Gait, Home, SceneFile, ScheduledEvent, VehicleFile
from fluid_sim_ros.schema.settings import integrator as integrator_of
from fluid_sim_ros.schema.waves import Waves
from fluid_sim_ros.schema.weather import CurrentModel, WindModel


@dataclass(frozen=True)
class CompiledScene:
    """
    A MuJoCo model with the scene's names resolved to ids.

    ``streams`` names what of wind and current the scene has; ``keyframe_id`` is -1 for none.
    """

    model: mujoco.MjModel
    vehicles: dict[str, Vehicle]
    schedule: Schedule
    gaits: Gaits
    keyframe_id: int
    streams: tuple[str, ...]


@dataclass(frozen=True)
class Scene:
    """
    A scene as its files state it; ``compile`` makes the model.

    Attributes
    ----------
    name
        Name in config/scenes, or the stem of the given file.
    model_path
        The MJCF file.
    mjcf
        The model itself as text, in place of the file.
    description, medium, duration, keyframe, home, waves, wind, current, schedule, gait
        As in the YAML file (config/scenes); ``medium`` is ``air``, ``water`` or None (by density).
    timestep, integrator, fluid
        In place of the model's; see ``compile``.
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
    mjcf: str = ''
    timestep: float | None = None
    integrator: str | None = None
    fluid: str | None = None
    advised: Advised | None = None
    masses: dict[str, float] = field(default_factory=dict)

    @classmethod
    def load(cls, scene: 'str | Path | Scene') -> 'Scene':
        """
        Read a scene by name, or by the path of a scene YAML file or an MJCF file.

        Raises
        ------
        ConfigError
            If no such scene exists, or its YAML has a fault (file, key, value, what is allowed).

        """
        if isinstance(scene, Scene):
            return scene
        path = Path(scene)
        if path.suffix in ('.yaml', '.yml'):
            return _from_yaml(path)
        if path.suffix in ('.xml', '.mjcf') or path.is_file():
            if not path.is_file():
                raise ConfigError(f'{path}: no such MJCF file')
            return cls(name=path.stem, model_path=path.resolve())
        if str(scene) not in scene_names():
            raise ConfigError(
                f"scene '{scene}' is not known; scenes: {listed(scene_names())}; "
                'or give the path of an MJCF (.xml) or scene (.yaml) file'
            )
        by_name = config_folder() / 'scenes' / f'{scene}.yaml'
        if by_name.is_file():
            return _from_yaml(by_name)
        return cls(name=str(scene), model_path=models_folder() / f'{scene}.xml')

    def compile(
        self,
        *,
        timestep: float | None = None,
        integrator: str | None = None,
        fluid: str | None = None,
        seed: int = 0,
    ) -> CompiledScene:
        """
        Compile the model and resolve every name.

        Parameters
        ----------
        timestep
            Replaces the scene's timestep [s]; without either the model's holds, as for the others.
        integrator
            Replaces the model's integrator, one of ``INTEGRATORS`` (any case).
        fluid
            Replaces the model's fluid forces, one of ``FLUID_RUNGS``.
        seed
            Of the weather's random processes.

        Raises
        ------
        ConfigError, ModelError
            For a wrong option, a model that does not load, or names that the model lacks.

        """
        load_plugins()
        timestep = self.timestep if timestep is None else timestep
        integrator = self.integrator if integrator is None else integrator
        fluid = self.fluid if fluid is None else fluid
        spec = self.read_model()
        scale_masses(spec, self.masses, self.model_path)
        if timestep is not None:
            if not (np.isfinite(timestep) and timestep > 0):
                raise ConfigError(f'timestep {timestep} s: must be finite and above 0')
            spec.option.timestep = timestep
        if integrator is not None:
            spec.option.integrator = integrator_of(integrator)
        dry = None
        if fluid == 'none':  # wind and current still may be commanded, to no effect
            dry = streams_of(compile_spec(spec, self.model_path), self.medium)
        if fluid is not None:
            force_fluid(spec, fluid, self.model_path)
        if self.waves is not None and fluid in (None, 'no_added_mass'):  # others: no surface
            _add_waves(spec, self.waves.keys(seed), self.name)
        if fluid != 'none':
            apply_weather(spec, self.wind, self.current, seed, self.name)
        model = compile_spec(spec, self.model_path)
        vehicles = self._vehicles(model)
        schedule = Schedule(self.schedule, model.opt.timestep)
        _check_schedule(self, vehicles)
        gaits = Gaits(self.gait, vehicles, model.opt.timestep)
        streams = dry or streams_of(model, self.medium)
        self._check_weather(streams)
        return CompiledScene(model, vehicles, schedule, gaits, self._keyframe_id(model), streams)

    def read_model(self) -> mujoco.MjSpec:
        """Return the model as it is written, or raise ModelError."""
        try:
            if self.mjcf:
                return mujoco.MjSpec.from_string(self.mjcf)
            return mujoco.MjSpec.from_file(str(self.model_path))
        except ValueError as error:
            raise ModelError(f'{self.model_path}: {" ".join(str(error).split())}') from None

    def _vehicles(self, model: mujoco.MjModel) -> dict[str, Vehicle]:
        files = self.vehicles
        if files is None:
            files = free_bodies(model, self.model_path)
        return {
            name: resolve(name, file, model, f'{self.name}: vehicle {name!r}')
            for name, file in files.items()
        }

    def _check_weather(self, streams: tuple[str, ...]) -> None:
        for name, models in (('wind', self.wind), ('current', self.current)):
            if models and name not in streams:
                raise ConfigError(
                    f"{self.name}: key '{name}': the scene has no such medium; "
                    f'it has: {listed(streams)}'
                )

    def _keyframe_id(self, model: mujoco.MjModel) -> int:
        if self.keyframe is None:
            return -1
        identity = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, self.keyframe)
        if identity < 0:
            names = [model.key(i).name for i in range(model.nkey)]
            raise ConfigError(
                f"{self.name}: keyframe '{self.keyframe}' is not in the model; "
                f'it has: {listed(names)}'
            )
        return int(identity)


def scene_names() -> list[str]:
    """Return the names that ``Scene.load`` knows, sorted."""
    names = {path.stem for path in (config_folder() / 'scenes').glob('*.yaml')}
    names |= {path.stem for path in models_folder().glob('*.xml')}
    return sorted(names)


def _from_yaml(path: Path) -> Scene:
    content = parse(SceneFile, read_yaml(path), path)
    model_path = (path.parent / content.model).resolve()
    if not content.model.endswith(('.xml', '.mjcf')):
        model_path = models_folder() / f'{content.model}.xml'
    if not model_path.is_file():
        known = listed(sorted(p.stem for p in models_folder().glob('*.xml')))
        raise ConfigError(
            f"{path}: key 'model': no model '{content.model}'; models: {known}; "
            'or give the path of an MJCF file, relative to this file'
        )
    vehicles = None
    if content.vehicles is not None:
        vehicles = {
            name: _vehicle_file(value, path) if isinstance(value, str) else value
            for name, value in content.vehicles.items()
        }
    return Scene(
        name=path.stem,
        model_path=model_path,
        description=content.description,
        medium=content.medium,
        duration=content.duration,
        keyframe=content.keyframe,
        home=content.home,
        waves=content.waves,
        wind=with_files(content.wind, path.parent),
        current=with_files(content.current, path.parent),
        schedule=tuple(content.schedule),
        gait=content.gait,
        vehicles=vehicles,
        timestep=content.timestep,
        integrator=content.integrator,
        fluid=content.fluid,
        advised=content.advised,
    )


def _vehicle_file(name: str, scene_path: Path) -> VehicleFile:
    folder = config_folder() / 'vehicles'
    beside = scene_path.parent / name
    path = beside if name.endswith(('.yaml', '.yml')) else folder / f'{name}.yaml'
    if not path.is_file():
        known = listed(sorted(p.stem for p in folder.glob('*.yaml')))
        raise ConfigError(f"{scene_path}: vehicle file '{name}' is not known; vehicles: {known}")
    return parse(VehicleFile, read_yaml(path), path)


def _add_waves(spec: mujoco.MjSpec, keys: dict[str, str], name: str) -> None:
    media = [p for p in spec.plugins if p.plugin_name == 'fluid_sim.medium' and p.name]
    if not media:
        raise ConfigError(
            f"{name}: key 'waves': the model has no free surface; "
            'give it a fluid_sim.medium with surface'
        )
    media[0].config = {**media[0].config, **keys}


def _check_schedule(scene: Scene, vehicles: dict[str, Vehicle]) -> None:
    """Refuse a schedule or gait of unknown vehicles, or thrust of the wrong length."""
    for name in scene.gait:
        if name not in vehicles:
            raise ConfigError(
                f"{scene.name}: gait: vehicle '{name}' is not in the scene; "
                f'it has: {listed(vehicles)}'
            )
    for event in scene.schedule:
        where = f'{scene.name}: schedule at {event.at:g} s'
        for name in (*event.thrust, *event.wrench):
            if name not in vehicles:
                raise ConfigError(
                    f"{where}: vehicle '{name}' is not in the scene; it has: {listed(vehicles)}"
                )
        for name, values in event.thrust.items():
            expected = len(vehicles[name].thrusters)
            if len(values) != expected:
                raise ConfigError(
                    f"{where}: thrust of '{name}' has {len(values)} values; it needs {expected}"
                )
