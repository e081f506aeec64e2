# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The files that a film goes to: MP4, GIF, or one picture as PNG."""

import errno
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]

KINDS = ('.mp4', '.gif', '.png')
#: Free space below which ffmpeg has failed for want of it [bytes]: it writes in larger parts.
_FULL = 1 << 20


class FilmFile(Protocol):
    """A file that takes pictures."""

    def add(self, picture: Picture) -> None:
        """
        Take the next picture.

        Parameters
        ----------
        picture
            Red, green and blue, shape (height, width, 3).

        """

    def close(self) -> None:
        """End the file."""


def film_file(out: Path, width: int, height: int, rate: float) -> FilmFile:
    """
    Return the file of a film, by its ending.

    Parameters
    ----------
    out
        File to write: ``.mp4``, ``.gif`` or ``.png``.
    width, height
        Size of a picture [pixels].
    rate
        Pictures per second.

    Returns
    -------
    FilmFile
        Takes the pictures.

    """
    return _Video(out, width, height, rate) if out.suffix == '.mp4' else _Images(out, rate)


class _Video(FilmFile):
    """An MP4 file, through ffmpeg."""

    def __init__(self, out: Path, width: int, height: int, rate: float) -> None:
        import imageio_ffmpeg

        self._out, self._pictures = out, 0
        # what ffmpeg itself says goes to the terminal, with names of files of ours that pass
        self._generator: Any = imageio_ffmpeg.write_frames(
            str(out), (width, height), fps=rate, quality=7, ffmpeg_log_level='quiet'
        )
        self._do(lambda: self._generator.send(None))

    def add(self, picture: Picture) -> None:
        self._pictures += 1
        self._do(lambda: self._generator.send(np.ascontiguousarray(picture)))

    def close(self) -> None:
        self._do(self._generator.close)
        if self._pictures and not self._out.stat().st_size:
            raise self._fault()

    def _do(self, work: Callable[[], object]) -> None:
        try:
            work()
        except OSError:  # all that ffmpeg has said, on many lines
            raise self._fault() from None

    def _fault(self) -> OSError:
        if shutil.disk_usage(self._out.parent).free < _FULL:
            return OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return OSError(errno.EIO, 'ffmpeg failed')


class _Images(FilmFile):
    """A GIF file, or one PNG."""

    def __init__(self, out: Path, rate: float) -> None:
        self._out = out
        self._duration = 1000.0 / rate
        self._frames: list[Any] = []

    def add(self, picture: Picture) -> None:
        from PIL import Image

        image: Any = Image.fromarray(picture)
        if self._out.suffix == '.gif':  # a palette at once: a third of the memory
            image = image.quantize(128)
        self._frames.append(image)

    def close(self) -> None:
        if not self._frames:
            return
        first, *others = self._frames
        if self._out.suffix == '.gif':
            first.save(
                self._out, save_all=True, append_images=others, duration=self._duration, loop=0
            )
        else:
            first.save(self._out)
