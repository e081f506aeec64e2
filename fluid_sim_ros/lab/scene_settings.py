"""Writes advised settings into a scene's YAML file, in force or to be kept, comments kept."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml

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
        raise ConfigError(
            f"'{scene}' has no scene file (YAML) to write to; "
            'without --apply and --keep the advice is only shown'
        )
    return path


def apply(scene: str, lines: str, settings: dict[str, Any]) -> Path:
    """
    Put settings in force in a scene's file, in place of what it says of them; return the file.

    ``lines`` is the text, comment included; ``settings`` what a reader must find afterwards.

    Raises
    ------
    ConfigError
        If the file cannot be written, or would not say what it should.

    """
    old = rf'^(?:(?:{"|".join(_KEYS)}):|# fluid_sim advise ).*\n?'
    return _replaced(
        scene, old, lines, lambda found: {key: getattr(found, key) for key in _KEYS} == {
            key: settings.get(key) for key in _KEYS
        },
    )  # fmt: skip


def keep(scene: str, lines: str) -> Path:
    """
    Write the advised settings into a scene's file, beside its own; return the file.

    Raises
    ------
    ConfigError
        As for ``apply``.

    """
    old = r'^(?:advised:.*\n?(?:[ \t]+.*\n?)*|# advised .*\n?)'
    wanted = yaml.safe_load(lines)['advised']
    return _replaced(scene, old, lines, lambda found: (
        found.advised is not None and found.advised.model_dump(exclude_none=True) == wanted
    ))  # fmt: skip


def _replaced(scene: str, old: str, lines: str, right: Callable[[Scene], bool]) -> Path:
    """Put lines in place of what matches ``old``; undo it where the file then is not right."""
    path = scene_file(scene)
    before = path.read_text(encoding='utf-8')
    text = re.sub(old, '', before, flags=re.MULTILINE)
    text += lines if text.endswith('\n') else '\n' + lines
    try:
        path.write_text(text, encoding='utf-8')
    except OSError as error:
        raise ConfigError(f'{path}: cannot be written ({error.strerror})') from None
    try:
        good = right(Scene.load(path))
    except ConfigError:
        good = False
    if not good:
        path.write_text(before, encoding='utf-8')
        raise ConfigError(
            f'{path}: the settings could not be put in; write them by hand:\n{lines}'
        )
    return path
