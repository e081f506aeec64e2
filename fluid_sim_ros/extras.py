"""Optional parts, whose packages may be missing where they are wanted."""

from collections.abc import Iterator
from contextlib import contextmanager

from fluid_sim_ros.errors import MissingExtraError


@contextmanager
def needed_for(what: str) -> Iterator[None]:
    """
    Say in one line what to do where a package is missing that ``what`` needs.

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
