# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The files of a recording: one per segment, each beginning at simulated time 0."""

from pathlib import Path

from fluid_sim_ros.errors import ConfigError


def create_segment(path: Path, number: int) -> Path:
    """
    Make the empty file of a segment; an existing one is never overwritten.

    Parameters
    ----------
    path
        Of the recording: a ``.mcap`` file, or the folder of one (a rosbag2 bag).
    number
        Of the segment; all but 0 get it behind their name.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        If it exists already, or cannot be made.

    """
    file = _segment_path(path, number)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch(exist_ok=False)
    except FileExistsError:
        raise ConfigError(f'record: {file} exists already; choose another path') from None
    except OSError as error:
        raise ConfigError(f'record: {file}: {error.strerror}') from None
    return file


def _segment_path(path: Path, number: int) -> Path:
    if path.suffix == '.mcap':
        return path.with_stem(f'{path.stem}_{number}') if number else path
    folder = path.with_name(f'{path.name}_{number}') if number else path
    return folder / f'{folder.name}_0.mcap'
