# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's renderer, or one line that says why there is none here."""

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco

from fluid_sim_ros.errors import ConfigError, MachineError

_REMEDY = 'without a display set MUJOCO_GL=egl (or osmesa) before Python starts'
_NO_EGL = (
    'EGL, by which pictures are drawn without a display, does not work here; install it: '
    'apt-get install libegl1 libgl1-mesa-dri'
)
#: Why drawing failed before anything was drawn. MuJoCo looks for OpenGL once per process, at the
#: first picture; after a failure a second attempt would end the process (4.0.0).
_failures: list[str] = []
_drawn: list[bool] = []


def new_renderer(model: mujoco.MjModel, width: int, height: int) -> mujoco.Renderer:
    """
    Return a renderer.

    Parameters
    ----------
    model
        What is drawn.
    width, height
        Of the pictures [pixels].

    Returns
    -------
    mujoco.Renderer
        To be closed.

    Raises
    ------
    ConfigError
        If no picture of this size can be drawn here; a ``MachineError`` if none at all.

    """
    begin = f'render: no picture of {width} x {height} pixels can be drawn here: '
    with only_once(begin, _REMEDY):
        try:
            return mujoco.Renderer(model, height, width)
        except AttributeError:  # MUJOCO_GL says so
            raise MachineError(begin + f'MuJoCo was told to draw nothing; {_REMEDY}') from None


def bound_buffers(
    model: mujoco.MjModel, width: int, height: int, *, shadows: int, samples: int
) -> None:
    """
    Have OpenGL keep no larger pictures of a model than are wanted, whatever the model asks for.

    Parameters
    ----------
    model
        What is drawn; changed.
    width, height
        Of the pictures [pixels].
    shadows
        Most pixels of a side of the shadow map.
    samples
        Most samples of a pixel; 0: none beside the one in its middle.

    """
    quality, size = model.vis.quality, model.vis.global_
    size.offwidth, size.offheight = width, height
    quality.shadowsize = min(quality.shadowsize, shadows)
    quality.offsamples = min(quality.offsamples, samples)


@contextmanager
def only_once(begin: str, remedy: str) -> Iterator[None]:
    """
    Make what draws within, where that has not failed in this process before.

    Parameters
    ----------
    begin
        What an error begins with.
    remedy
        What helps where there is no OpenGL.

    Returns
    -------
    Iterator
        A context.

    Raises
    ------
    ConfigError
        If this cannot be drawn here, in one line; a ``MachineError`` if nothing can.

    """
    if _failures:
        raise MachineError(begin + _failures[0])
    try:
        yield
    except (mujoco.FatalError, RuntimeError, ValueError) as error:
        why = ' '.join(str(error).split())
        if isinstance(error, mujoco.FatalError) and not _drawn:
            why = f'{why}; {remedy}'
            _failures.append(why)
            raise MachineError(begin + why) from None
        raise ConfigError(begin + why) from None
    _drawn.append(True)


@contextmanager
def by_egl(begin: str) -> Iterator[None]:
    """
    As ``only_once``, for what draws by EGL, whatever MUJOCO_GL says.

    Parameters
    ----------
    begin
        What an error begins with.

    Returns
    -------
    Iterator
        A context.

    Raises
    ------
    MachineError
        If nothing can be drawn here, in one line.

    """
    with only_once(begin, _NO_EGL):
        try:
            from OpenGL.error import Error as OpenGLError
        except ImportError as error:
            raise MachineError(f'{begin}{error}; {_NO_EGL}') from None
        try:
            yield
        except (ImportError, AttributeError, OpenGLError) as error:  # no library, no device
            raise MachineError(f'{begin}{" ".join(str(error).split())}; {_NO_EGL}') from None
