# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Write config/foxglove/<vehicle>.json for every vehicle of config/vehicles, from its topics.

``quadrotor.json`` is that of the quadrotor scene, whose vehicle has no sensors. Run by
``make docs``; a test fails when a file is not what would be written.
"""

import json
from pathlib import Path

from fluid_sim_ros import Scene, Simulation, scene_names
from fluid_sim_ros.messages.foxglove import vehicle_layout
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics

FOLDER = Path(__file__).resolve().parents[1] / 'config/foxglove'


def shown() -> dict[str, tuple[str, str]]:
    """Return scene and vehicle by the name of the layout."""
    found: dict[str, tuple[str, str]] = {}
    for scene in scene_names():
        loaded = Scene.load(scene)
        if loaded.fleet is not None:  # its vehicles have layouts by the name of their model
            continue
        for vehicle in loaded.vehicles or {}:
            # the scene that is called as the vehicle is, before others that it is in
            if vehicle not in found or scene == vehicle:
                found[vehicle] = (scene, vehicle)
    found['quadrotor'] = ('quadrotor', 'x500')
    return found


def text_of(scene: str, vehicle: str) -> str:
    """Return the layout of a vehicle as it is written."""
    layout = vehicle_layout(StateTopics(Simulation(scene), DEFAULTS), vehicle)
    return json.dumps(layout, indent=1) + '\n'


if __name__ == '__main__':
    for name, (scene, vehicle) in shown().items():
        path, text = FOLDER / f'{name}.json', text_of(scene, vehicle)
        if not path.exists() or path.read_text(encoding='utf-8') != text:
            path.write_text(text, encoding='utf-8')
            print(f'docs: wrote {path.relative_to(FOLDER.parents[1])}')
