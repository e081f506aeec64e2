"""All that is needed to run a log's flight again: written into the log, and read from it."""

import json
import platform
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path, PurePosixPath
from typing import Any

import mujoco
import numpy as np
from pydantic import TypeAdapter

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.loop.recorder_port import RecordedTopic, RecorderOptions
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.wind_and_current import SavedStreams

#: Version of the layout of the attachments below.
FORMAT = 1
RUN, STATE, MODEL = 'fluid_sim/run.json', 'fluid_sim/state.f64', 'fluid_sim/model/'

#: Turns every field of a scene into JSON and back.
_SCENE = TypeAdapter(Scene)


class LogError(FluidSimError):
    """A log is not readable, or lacks what was asked of it."""


@dataclass(frozen=True)
class RunDescription:
    """
    A recorded run but for its commands.

    Attributes
    ----------
    run
        Versions, scene, options, settings, namespace; see ``describe``.
    state
        State of the engine at the begin, as ``Simulation.save_state`` has it.
    files
        The MJCF file and all that it refers to, by path relative to their common folder.

    """

    run: dict[str, Any]
    state: bytes
    files: dict[str, bytes]

    def attachments(self) -> dict[str, bytes]:
        """Return what the log's attachments are."""
        found = {RUN: json.dumps(self.run, indent=1).encode(), STATE: self.state}
        return found | {MODEL + path: content for path, content in self.files.items()}

    @classmethod
    def of_attachments(cls, attachments: Mapping[str, bytes]) -> 'RunDescription':
        """
        Read a description back.

        Parameters
        ----------
        attachments
            Content by name.

        Returns
        -------
        RunDescription
            The description.

        Raises
        ------
        LogError
            If the attachments are missing or were written by a newer release.

        """
        missing = [name for name in (RUN, STATE) if name not in attachments]
        if missing:
            raise LogError(f'the log has no attachment {missing[0]}: its run cannot be repeated')
        run = json.loads(attachments[RUN])
        if run.get('format') != FORMAT:
            raise LogError(f'the log has format {run.get("format")}, this release reads {FORMAT}')
        files = {
            name.removeprefix(MODEL): data
            for name, data in attachments.items()
            if name.startswith(MODEL)
        }
        return cls(run, attachments[STATE], files)

    def scene(self, folder: Path) -> Scene:
        """
        Write the model's files below ``folder`` and return the scene that uses them.

        Parameters
        ----------
        folder
            Empty folder, which the scene needs as long as it is used.

        Returns
        -------
        Scene
            The scene as it was run.

        Raises
        ------
        LogError
            If a file would stand outside of the folder.

        """
        for name, content in self.files.items():
            if '..' in PurePosixPath(name).parts or PurePosixPath(name).is_absolute():
                raise LogError(f"attachment '{MODEL}{name}' points out of its folder")
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        stated = self.run['scene']
        path = folder / stated['model_path']
        scene: Scene = _SCENE.validate_python({**stated, 'model_path': path})
        return scene

    def restore(self, simulation: Simulation, changed: bool = False) -> None:
        """
        Bring a new simulation of the scene to the state at the log's begin.

        A ``changed`` simulation whose state has another size (such as without plugins) begins at
        the scene's keyframe instead.

        Parameters
        ----------
        simulation
            New, of the recorded scene.
        changed
            Whether it differs from the recorded one in a setting.

        """
        streams, saved = self.run['streams'], simulation.save_state()
        engine = np.frombuffer(self.state, '<f8').copy()
        if changed and engine.shape != saved.engine.shape:
            engine = saved.engine
        commanded = SavedStreams(
            np.array(streams['wind']), np.array(streams['current']), streams['enabled']
        )
        simulation.load_state(replace(saved, engine=engine, streams=commanded))
        if changed:  # the recorded state holds the noise of the recorded seed
            simulation.reseed()


def describe(
    simulation: Simulation, topics: Sequence[RecordedTopic], options: RecorderOptions
) -> RunDescription:
    """
    Return the description of a simulation that stands at step 0.

    Parameters
    ----------
    simulation
        At step 0.
    topics
        What is recorded.
    options
        Of the recording; its settings become part of the description.

    Returns
    -------
    RunDescription
        The description.

    Raises
    ------
    LogError
        If it does not.

    """
    if simulation.step_count:
        raise LogError('a recording must begin at step 0 (after a reset)')
    saved = simulation.save_state()
    model_path, files = model_files(simulation.scene.model_path)
    integrator = mujoco.mjtIntegrator(simulation.model.opt.integrator).name
    run = {
        'format': FORMAT,
        'versions': {
            'fluid_sim_ros': __version__,
            'git_commit': git_commit(),
            'mujoco': mujoco.__version__,
            'numpy': np.__version__,
            'mcap': metadata.version('mcap'),
            'python': platform.python_version(),
            'machine': f'{platform.system()} {platform.machine()}',
        },
        'scene': _SCENE.dump_python(simulation.scene, mode='json') | {'model_path': model_path},
        'seed': simulation.seed,
        'timestep': simulation.timestep,
        'integrator': integrator.removeprefix('mjINT_').lower(),
        'fluid': simulation.settings.fluid,
        'namespace': options.namespace,
        'topics': {topic.name: topic.key for topic in topics},
        'settings': dict(options.settings),
        'streams': {
            'wind': saved.streams.wind_w.tolist(),
            'current': saved.streams.current_w.tolist(),
            'enabled': saved.streams.enabled,
        },
    }
    return RunDescription(run, saved.engine.astype('<f8').tobytes(), files)


def model_files(path: Path) -> tuple[str, dict[str, bytes]]:
    """
    Return an MJCF's relative path and the content of it and of every file it refers to.

    Parameters
    ----------
    path
        MJCF file.

    Returns
    -------
    path, files
        Path of the model, relative to the folder that holds all of its files, and their content by
        such a path.

    """
    paths = {Path(name).resolve() for name in mujoco.mju_getXMLDependencies(str(path))}
    paths = {p for p in paths if p.is_file()} | {path.resolve()}
    root = path.resolve().parent
    while not all(p.is_relative_to(root) for p in paths):
        root = root.parent
    files = {p.relative_to(root).as_posix(): p.read_bytes() for p in sorted(paths)}
    return path.resolve().relative_to(root).as_posix(), files


def git_commit() -> str | None:
    """Return the commit of the source tree that this package runs from, if it is one."""
    root = Path(__file__).resolve().parents[2]
    if not (root / '.git').exists():
        return None
    command = ['git', '-C', str(root), 'rev-parse', 'HEAD']
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=5)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip() or None
