"""MuJoCo's renderer, or one line that says why there is none here."""

import mujoco

from fluid_sim_ros.errors import ConfigError

_REMEDY = 'without a display set MUJOCO_GL=egl (or osmesa) before Python starts'
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
        If nothing, or no picture of this size, can be drawn here.

    """
    begin = f'render: no picture of {width} x {height} pixels can be drawn here: '
    if _failures:
        raise ConfigError(begin + _failures[0])
    try:
        renderer = mujoco.Renderer(model, height, width)
    except AttributeError:  # MUJOCO_GL says so
        raise ConfigError(begin + f'MuJoCo was told to draw nothing; {_REMEDY}') from None
    except (mujoco.FatalError, RuntimeError, ValueError) as error:
        why = ' '.join(str(error).split())
        if isinstance(error, mujoco.FatalError) and not _drawn:
            why = f'{why}; {_REMEDY}'
            _failures.append(why)
        raise ConfigError(begin + why) from None
    _drawn.append(True)
    return renderer
