# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The files that a model names are regular files, or MuJoCo is not asked to read them.

It would wait for a pipe without end, read a device without end, and take a folder for a file. What
is missing or damaged it says itself.
"""

import re
import stat
from pathlib import Path

from fluid_sim_ros.errors import ModelError, printable
from fluid_sim_ros.schema.data_file import kind_of

_COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)
#: Attributes that name files in MJCF (``file``, ``fileleft``, ...) and URDF (``filename``).
_NAME = re.compile(r'\bfile\w*\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')
_FOLDER = re.compile(r'\b(?:meshdir|texturedir|assetdir)\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')
#: What may be another model, which names files itself.
_MODELS = ('.xml', '.mjcf', '.urdf')
#: Models whose text is searched; MuJoCo itself ends at circles.
_MOST_MODELS = 1000


def check_named_files(path: Path, text: str) -> None:
    """
    Check that all that a model names, and the models that it includes, is no pipe or the like.

    A file is looked for in each folder in which MuJoCo may look: that of the model, that of the
    file that names it, and those that any of them states.

    Parameters
    ----------
    path
        Of the model.
    text
        Its content.

    Raises
    ------
    ModelError
        For what is there and no regular file.

    """
    texts, folders = [(path.parent, text)], {Path()}
    named: list[tuple[Path, str]] = []
    seen = {path}
    while texts:
        place, content = texts.pop()
        content = _COMMENT.sub('', content)
        folders |= {Path(name) for name in _values(_FOLDER, content)}
        for name in _values(_NAME, content):
            named.append((place, name))
            for base in (path.parent, place):
                other = base / name
                if (
                    name.lower().endswith(_MODELS) and other not in seen
                    and len(seen) < _MOST_MODELS and _mode(other, stat.S_IFREG)
                ):  # fmt: skip
                    seen.add(other)
                    texts.append((other.parent, other.read_text('utf-8', 'replace')))
    for place, name in dict.fromkeys(named):
        _check(path, place, name, folders)


def _values(pattern: re.Pattern[str], text: str) -> list[str]:
    return [first or second for first, second in pattern.findall(text)]


def _check(path: Path, place: Path, name: str, folders: set[Path]) -> None:
    bare = name.rpartition('/')[2]  # with strippath
    places = [
        base / folder / each
        for base in dict.fromkeys((path.parent, place)) for folder in folders
        for each in dict.fromkeys((name, bare)) if each
    ]  # fmt: skip
    if any(_mode(each, stat.S_IFREG) for each in places):
        found = [each for each in places if _mode(each, stat.S_IFIFO, stat.S_IFSOCK)]
    else:
        found = [each for each in places if _mode(each) not in (0, stat.S_IFREG)]
    if found:
        raise ModelError(
            f"{path}: names '{printable(name)}', and {printable(str(found[0]), 1000)} is "
            f'{kind_of(found[0])}; only regular files are read'
        )


def _mode(path: Path, *wanted: int) -> int:
    """Return the type of a file, one of ``stat.S_IF...``; 0: there is none, or another one."""
    try:
        mode = stat.S_IFMT(path.stat().st_mode)
    except (OSError, ValueError):
        return 0
    return mode if not wanted or mode in wanted else 0
