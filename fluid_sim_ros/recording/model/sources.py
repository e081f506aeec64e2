# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where a model's files come from: the disk, within chosen folders, or a log's attachments."""

import os
import posixpath
import stat
from collections.abc import Mapping, Sequence
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.recording.model.files import gather
from fluid_sim_ros.recording.model.mjcf_text import MjcfError
from fluid_sim_ros.resources import models_folder
from fluid_sim_ros.schema.limits import check_limit


def model_of_disk(
    path: Path, allowed: Sequence[Path] = (), text: str = ''
) -> tuple[str, dict[str, bytes]]:
    """
    Return a model and every file that it names, as a log attaches them.

    Parameters
    ----------
    path
        MJCF or URDF file.
    allowed
        Folders from which files may come, beside the model's own and that of our models.
    text
        Of the model, in place of the file's.

    Returns
    -------
    path, files
        Path of the model, relative to the folder that holds all of its files, and their content
        by such a path.

    Raises
    ------
    ConfigError
        For a file outside of the folders (a log is sent around, and who wrote the model could
        have named any file of this machine), one that is missing or no regular file, or a model
        that would not be the same from the log.

    """
    absolute = posixpath.normpath(posixpath.join(Path.cwd(), path))
    disk = _DiskFiles(absolute, allowed)
    try:
        found = gather(absolute, disk.read, text.encode() if text else None)
    except MjcfError as error:
        raise ConfigError(f'record: {path}: {error}') from None
    used = found.used | ({absolute: text.encode()} if text else {})
    root = posixpath.dirname(absolute)
    while not all(name.startswith(root.rstrip('/') + '/') for name in used):
        root = posixpath.dirname(root)
    files = {posixpath.relpath(name, root): content for name, content in sorted(used.items())}
    model = posixpath.relpath(absolute, root)
    again = gather(model, AttachedFiles(files).read)
    if (again.text, again.assets) != (found.text, found.assets):
        raise ConfigError(
            f'record: {path}: from the log it would find other files than from the disk; '
            'name its files by paths relative to the model'
        )
    return model, files


def files_of(
    path: Path, mjcf: str, assets: Mapping[str, bytes], allowed: Sequence[Path]
) -> tuple[str, dict[str, bytes]]:
    """
    Return a model and the files that it names, by paths as a log has them.

    Parameters
    ----------
    path
        MJCF or URDF file.
    mjcf, assets
        The model as text in place of the file, or '', and its files where it came out of a log.
    allowed
        As for ``model_of_disk``.

    Raises
    ------
    ConfigError
        As ``model_of_disk``.

    """
    if assets:  # it came out of a log
        name = f'{path.stem}.xml'
        return name, {name: mjcf.encode(), **assets}
    return model_of_disk(path, allowed, mjcf)


class _DiskFiles:
    """Reads regular files inside some folders."""

    def __init__(self, model: str, allowed: Sequence[Path]) -> None:
        self._model = model
        folders = [posixpath.dirname(model), str(models_folder()), *map(str, allowed)]
        self._folders = [os.path.realpath(folder) for folder in folders]
        self._size = 0

    def read(self, path: str) -> bytes | None:
        """Return a file's content, or None where there is none."""
        real = os.path.realpath(path)
        if not os.path.lexists(real):
            return None
        if path != self._model and not any(
            os.path.commonpath([real, folder]) == folder for folder in self._folders
        ):
            folder = printable(posixpath.dirname(real), 1000)
            raise ConfigError(
                f"record: {self._model} names '{printable(path, 1000)}', outside of its folder: "
                f'the log would hold that file; --allow-assets-from {folder} (in the node '
                'record.allow_assets_from) permits it'
            )
        try:
            handle = os.open(real, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOFOLLOW)
        except OSError as error:
            raise ConfigError(f'record: {printable(path, 1000)}: {error.strerror}') from None
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode):
            os.close(handle)
            raise ConfigError(f'record: {printable(path, 1000)}: not a regular file')
        with os.fdopen(handle, 'rb') as file:
            self._size += status.st_size
            check_limit('log_attachment_bytes', self._size, f'record: the files of {self._model}')
            return file.read()


class AttachedFiles:
    """
    Reads the files that a log has attached, and none beside them.

    Parameters
    ----------
    files
        Content by path, relative to the folder that held all of them.

    """

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files

    def read(self, path: str) -> bytes | None:
        """
        Return a file's content.

        Parameters
        ----------
        path
            As the model names it. An absolute one stood where the model was recorded: its end
            is the path of the attachment.

        Returns
        -------
        bytes or None
            The content, None where there is no such attachment.

        """
        if not path.startswith('/'):
            return self._files.get(path)
        ends = [name for name in self._files if path.endswith(f'/{name}')]
        return self._files[max(ends, key=len)] if ends else None
