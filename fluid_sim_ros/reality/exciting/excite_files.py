# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An excitation as files: a scene whose schedule commands it, and a table for other software."""

from pathlib import Path
from typing import Any

import numpy as np
import yaml

from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.reality.exciting.excited_flight import Excited
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.scene import Scene

_TARGETS = ('forward', 'left', 'up', 'turn')


def write_schedule(found: Excited, path: Path, settings: str) -> Path:
    """
    Write a scene file that flies an excitation: ``fluid_sim run FILE --record LOG``.

    Parameters
    ----------
    found
        As ``excite`` returned it.
    path
        File to write.
    settings
        Of the manoeuvre in words.

    Returns
    -------
    Path
        The file.

    """
    events = [
        {'at': round(float(t), 9), 'thrust': {found.vehicle: [float(v) for v in row]}}
        for t, row in zip(found.plan.times, found.thrusts, strict=True)
    ]
    scene = found.scene
    content: dict[str, Any] = {
        'model': str(scene.model_path.resolve()),
        'description': f'{found.vehicle} excited: {found.plan.words}',
    }
    if scene.medium is not None:
        content['medium'] = scene.medium
    if scene.vehicles is not None:
        content['vehicles'] = {name: _vehicle(name, scene) for name in scene.vehicles}
    content |= {'duration': round(float(found.plan.times[-1] + found.plan.times[1]), 9)}
    if scene.keyframe is not None:
        content['keyframe'] = scene.keyframe
    stated = scene.settings
    for key in ('timestep', 'integrator', 'fluid'):
        if getattr(stated, key) is not None:
            content[key] = getattr(stated, key)
    head = yaml.safe_dump(content, sort_keys=False)
    body = yaml.safe_dump(events, default_flow_style=True, width=10_000)
    rows = body.strip()[1:-1].replace('}}, {', '}},\n  {')
    with new_file(path) as file:
        file.write_text(f'# {settings}\n{head}schedule: [\n  {rows}]\n', encoding='utf-8')
    return path


def _vehicle(name: str, scene: Scene) -> Any:
    given = (scene.vehicles or {})[name]
    if isinstance(given, str) or (config_folder() / 'vehicles' / f'{name}.yaml').exists():
        return name
    return given.model_dump(mode='json', exclude_defaults=True)


def write_csv(found: Excited, path: Path, settings: str) -> Path:
    """
    Write an excitation as a table: time [s], target [m], [rad], thrusts and what is added [N].

    Parameters
    ----------
    found
        As ``excite`` returned it.
    path
        File to write.
    settings
        Of the manoeuvre in words.

    Returns
    -------
    Path
        The file: ``target_*`` from the begin in the axes of the first heading, for a controller;
        ``thrust_NAME`` as flown by the model; ``free`` 1 where the thrusters are off.

    """
    names = found.flight.signals['thrust'].names
    columns = ['time', *(f'target_{name}' for name in _TARGETS), 'free',
               *(f'thrust_{name}' for name in names)]  # fmt: skip
    todo = found.plan
    table = np.concatenate(
        [todo.times[:, None], found.scale * todo.targets, todo.free[:, None], found.thrusts],
        axis=1,
    )
    lines = [f'# {settings}', ','.join(columns)]
    lines += [','.join(f'{value:.6g}' for value in row) for row in table]
    with new_file(path) as file:
        file.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return path
