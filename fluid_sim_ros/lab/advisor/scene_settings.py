# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Writes advised settings into a scene's YAML file, in force or to be kept.

ruamel.yaml makes the change. What it would write in another way than the author did (long lines
that are wrapped, for example) is taken from the file as it was, so that nothing but the settings
changes.
"""

import difflib
from collections.abc import Callable, Mapping
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap
from ruamel.yaml.error import YAMLError
from ruamel.yaml.scalarfloat import ScalarFloat
from ruamel.yaml.util import load_yaml_guess_indent

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.scene import Scene

_KEYS = ('timestep', 'integrator', 'fluid')
#: How a line begins that ``apply``, and one that ``keep`` of an earlier release, has left.
_APPLIED, _KEPT = '# fluid_sim advise ', '# advised '


def scene_file(scene: str) -> Path:
    """
    Return the YAML file of a scene.

    Parameters
    ----------
    scene
        Name of a scene, or path of its file.

    Returns
    -------
    Path
        The file, which exists.

    Raises
    ------
    ConfigError
        If the scene has no such file.

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


def apply(scene: str, settings: Mapping[str, Any], comment: str) -> Path:
    """
    Put settings in force in a scene's file, in place of what it says of them.

    Parameters
    ----------
    scene
        Name of a scene, or path of its file.
    settings
        Some of the keys ``timestep`` [s], ``integrator``, ``fluid``; the others are taken out.
    comment
        One line above them that says where they come from.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        If the file cannot be written, or would not say what it should.

    """
    wanted = {key: settings.get(key) for key in _KEYS}

    def holds(found: Scene) -> bool:
        return {key: getattr(found, key) for key in _KEYS} == wanted

    return _write(scene, wanted, comment, holds)


def keep(scene: str, advised: Mapping[str, Any]) -> Path:
    """
    Write advised settings into a scene's file, beside its own.

    Parameters
    ----------
    scene
        Name of a scene, or path of its file.
    advised
        What the key ``advised`` shall hold; see ``schema.advised.Advised``.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        If the file cannot be written, or would not say what it should.

    """

    def holds(found: Scene) -> bool:
        return found.advised is not None and found.advised.model_dump(exclude_none=True) == advised

    return _write(scene, {'advised': dict(advised)}, '', holds)


def _write(
    scene: str, changes: Mapping[str, Any], comment: str, holds: Callable[[Scene], bool]
) -> Path:
    """Change keys of a scene's file; it stays as it is where the new one would not be right."""
    path = scene_file(scene)
    try:
        before = path.read_bytes().decode()
        after = changed_text(before, changes, comment)
    except OSError as error:
        raise ConfigError(f'{path}: cannot be read ({error.strerror})') from None
    except (UnicodeDecodeError, YAMLError) as error:
        line = ' '.join(str(error).split())
        raise ConfigError(f'{path}: cannot be read as YAML: {line}') from None
    # whole, in the same folder, and tried, before it takes its place: also on a disk that is full
    with new_file(path.resolve()) as file:
        file.write_bytes(after.encode())
        try:
            good = holds(Scene.load(file)) and _others(before, changes) == _others(after, changes)
        except ConfigError:
            good = False
        if not good:
            stated = yaml.safe_dump(_stated(changes), default_flow_style=True, width=1 << 20)
            raise ConfigError(
                f'{path}: the settings could not be put in; write them by hand: {stated.strip()}'
            )
    return path


def _others(text: str, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a reader finds under the keys that do not change."""
    content = yaml.safe_load(text)
    return {key: value for key, value in content.items() if key not in changes}


def _stated(changes: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in changes.items() if value is not None}


def changed_text(text: str, changes: Mapping[str, Any], comment: str = '') -> str:
    """
    Return the text of a YAML file with some of its keys changed, and all else as it stands.

    Parameters
    ----------
    text
        The file; a mapping, in block or flow style, with any line ends.
    changes
        New values by key of the mapping; None takes a key out.
    comment
        One line above the first of them; such a line of an earlier change is taken out.

    Returns
    -------
    str
        The new text, with the same line ends.

    """
    ends = '\r\n' if '\r\n' in text else '\n'
    lines = text.replace('\r\n', '\n').splitlines(keepends=True)
    old = _APPLIED if comment else _KEPT
    before = ''.join(line for line in lines if not line.startswith(old))
    engine = _engine(before)
    content = engine.load(before)
    as_it_was = _dumped(engine, content)
    for key, value in changes.items():
        if value is None:
            content.pop(key, None)
        else:
            content[key] = _plain(value)
    after = _merged(before, as_it_was, _dumped(engine, content))
    if comment:
        after = _with_comment(after, f'# {comment}\n', next(iter(_stated(changes))))
    return after.replace('\n', ends)


def _engine(text: str) -> YAML:
    """Return a reader and writer that keeps quotes, line lengths and the indent of a text."""
    _, indent, offset = load_yaml_guess_indent(text)
    engine = YAML()
    engine.preserve_quotes = True
    engine.width = 1 << 20
    engine.explicit_start = text.startswith('---') or '\n---' in text
    if indent is not None:
        engine.indent(mapping=2, sequence=indent, offset=offset)
    return engine


def _dumped(engine: YAML, content: Any) -> str:
    stream = StringIO()
    engine.dump(content, stream)
    return stream.getvalue()


def _plain(value: Any) -> Any:
    """Return a value as both YAML 1.1 and 1.2 read it: 1e-05 is a text in the former."""
    if isinstance(value, dict):
        return CommentedMap({key: _plain(each) for key, each in value.items()})
    if isinstance(value, float):
        digits = np.format_float_positional(value, trim='0')
        whole = digits.index('.')
        return ScalarFloat(value, width=len(digits), prec=whole, m_sign=False, m_lead0=0)
    return value


def _merged(original: str, as_it_was: str, after: str) -> str:
    """
    Return ``after`` with every line that did not change as it stands in ``original``.

    ``as_it_was`` is ``original`` as the library writes it. Comments that stood beside something
    that was taken out stay.
    """
    old, same, new = (text.splitlines() for text in (original, as_it_was, after))
    written: list[list[str]] = [[] for _ in range(len(same) + 1)]
    for _, a, b, c, d in difflib.SequenceMatcher(None, old, same, False).get_opcodes():
        if b - a == d - c:
            for k in range(b - a):
                written[c + k].append(old[a + k])
        else:  # wrapped in another way: all of it with the first line
            written[c] += old[a:b]
    lines: list[str] = []
    for kind, a, b, c, d in difflib.SequenceMatcher(None, same, new, False).get_opcodes():
        if kind == 'equal':
            lines += [line for group in written[a:b] for line in group]
            continue
        lost = [line for line in same[a:b] if line not in new[c:d]]
        lines += [*new[c:d], *(line for line in lost if line.lstrip()[:1] in ('', '#'))]
    lines += written[-1]
    return ''.join(f'{line}\n' for line in lines)


def _with_comment(text: str, comment: str, key: str) -> str:
    """Return the text with a comment above a key, or at the top where keys share one line."""
    lines = text.splitlines(keepends=True)
    for number, line in enumerate(lines):
        if line.lstrip('\'"').startswith(key):
            return ''.join([*lines[:number], comment, *lines[number:]])
    return comment + text
