# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""All that is needed to run a log's flight again: written into the log, and read from it."""

import json
import platform
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros import __version__
from fluid_sim_ros.loop.recorder_port import RecordedTopic, RecorderOptions
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.recording.model.cost import check_elements
from fluid_sim_ros.recording.model.files import gather
from fluid_sim_ros.recording.model.fleet import (
    fleet_of_log,
    gathered_models,
    of_log,
    read_fleet,
)
from fluid_sim_ros.recording.model.sources import AttachedFiles, files_of
from fluid_sim_ros.recording.run_file import BESIDE, FORMAT, SCENE, read_run, read_scene
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.wind_and_current import SavedStreams

RUN, STATE, MODEL = 'fluid_sim/run.json', 'fluid_sim/state.f64', 'fluid_sim/model/'


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
        files = {
            name.removeprefix(MODEL): data
            for name, data in attachments.items()
            if name.startswith(MODEL)
        }
        return cls(read_run(attachments[RUN]), attachments[STATE], files)

    def scene(self) -> Scene:
        """
        Return the scene as it was run, made of the attachments alone: no file is opened.

        Raises
        ------
        FluidSimError
            If ``run.json`` or the model in the log has a fault, or names a file that is not
            attached.

        """
        stated = self.run['scene']
        text, path = stated.get('mjcf', ''), stated['model_path']
        if not isinstance(text, str):
            raise LogError("run.json: scene: key 'mjcf': must be a text")
        model = gather(path, AttachedFiles(self.files).read, text.encode() if text else None)
        fleet, models = None, []
        if stated.get('fleet') is not None:
            fleet = read_fleet(stated['fleet'])
            models = gathered_models(fleet, self.files)
            fleet = of_log(fleet, models)
        check_elements(model, *models)
        return Scene(
            **read_scene(stated), model_path=Path(path), mjcf=model.text, assets=model.assets,
            fleet=fleet,
        )  # fmt: skip

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

        Raises
        ------
        LogError
            If the recorded state does not fit the model.

        """
        streams, saved = self.run['streams'], simulation.save_state()
        if len(self.state) % 8:
            raise LogError(f"attachment '{STATE}' is cut")
        engine = np.frombuffer(self.state, '<f8').copy()
        if engine.shape != saved.engine.shape:
            if not changed:
                raise LogError(
                    f"attachment '{STATE}' holds {len(engine)} numbers; "
                    f'the model needs {len(saved.engine)}'
                )
            engine = saved.engine
        if not np.isfinite(engine).all():
            raise LogError(f"attachment '{STATE}' holds numbers that are not finite")
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
    scene = simulation.scene
    model_path, files = _model_files(scene, options)
    stated = SCENE.dump_python(scene, mode='json', exclude=BESIDE)
    if scene.fleet is not None:
        stated['fleet'], attached = fleet_of_log(scene.fleet, options)
        files |= attached
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
        'scene': stated | {'model_path': model_path},
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


def _model_files(scene: Scene, options: RecorderOptions) -> tuple[str, dict[str, bytes]]:
    """Return a scene's model and the files that it names, by paths as the log has them."""
    return files_of(scene.model_path, scene.mjcf, scene.assets, options.allow_assets_from)


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
