"""Errors that the package raises; each message is one line that says what is allowed."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager


class FluidSimError(Exception):
    """Base of every error that the package raises on purpose."""


class ConfigError(FluidSimError):
    """A scene, vehicle or parameter file is wrong; the message names file, key and value."""


class ModelError(FluidSimError):
    """An MJCF model does not load or does not fit the scene that names it."""


class CommandError(FluidSimError):
    """A command has the wrong length, a value that is not finite, or an unknown target."""


class PluginError(FluidSimError):
    """The MuJoCo plugin library is missing or was built for another MuJoCo version."""


class MissingExtraError(FluidSimError):
    """An optional part is not installed; the message says which extra brings it."""


class DivergedError(FluidSimError):
    """
    The simulation left the range of finite numbers.

    Parameters
    ----------
    message
        One line: what diverged, where and when.
    time
        Simulated time of the first bad step [s]; kept as an attribute.
    body
        Name of the body that holds the bad degree of freedom; kept as an attribute.

    """

    def __init__(self, message: str, *, time: float, body: str) -> None:
        super().__init__(message)
        self.time = time
        self.body = body


def listed(names: Iterable[str]) -> str:
    """
    Return names as the tail of an error message: ``a, b, c`` or ``(none)``.

    Parameters
    ----------
    names
        What is allowed or exists, in the order of the message.

    """
    return ', '.join(names) or '(none)'


@contextmanager
def needed_for(what: str) -> Iterator[None]:
    """
    Say in one line what to do where a package is missing that ``what`` needs.

    Parameters
    ----------
    what
        Beginning of the message: who needs the package.

    Returns
    -------
    context manager
        In which the package is imported.

    Raises
    ------
    MissingExtraError
        In place of a ModuleNotFoundError about a package of others.

    """
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith('fluid_sim_ros'):
            raise
        raise MissingExtraError(
            f'{what} needs {error.name}, which is not installed; '
            'fluid_sim doctor says what to type'
        ) from None
