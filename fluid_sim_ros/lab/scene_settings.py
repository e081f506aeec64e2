"""Writes timestep, integrator and fluid rung into a scene's YAML file, comments kept."""

import re
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.scene import Scene

_KEYS = ('timestep', 'integrator', 'fluid')


def scene_file(scene: str) -> Path:
    """
    Return the YAML file of a scene, by name or path.

    Raises
    ------
    ConfigError
        If it has none.

    """
    path = Path(scene)
    if path.suffix not in ('.yaml', '.yml'):
        path = config_folder() / 'scenes' / f'{scene}.yaml'
    if not path.is_file():
        raise ConfigError(f"--apply: '{scene}' has no scene file to write to")
    return path


def apply(scene: str, lines: str, settings: dict[str, Any]) -> Path:
    """
    Put settings into a scene's file in place of what it says of them; return the file.

    ``lines`` is the text, comment included; ``settings`` what a reader must find afterwards.

    Raises
    ------
    ConfigError
        If the file cannot be written, or would not say what it should.

    """
    path = scene_file(scene)
    before = path.read_text(encoding='utf-8')
    kept = [
        line
        for line in before.splitlines(keepends=True)
        if not re.match(rf'({"|".join(_KEYS)}):|# fluid_sim advise ', line)
    ]
    text = ''.join(kept)
    text += lines if text.endswith('\n') else '\n' + lines
    try:
        path.write_text(text, encoding='utf-8')
    except OSError as error:
        raise ConfigError(f'{path}: cannot be written ({error.strerror})') from None
    found = Scene.load(path)
    if any(getattr(found, key) != settings.get(key) for key in _KEYS):
        path.write_text(before, encoding='utf-8')
        raise ConfigError(f'{path}: the settings could not be put in; write them by hand')
    return path
