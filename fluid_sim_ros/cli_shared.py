"""What the subcommands of ``fluid_sim`` share."""

import argparse
from collections.abc import Callable
from typing import Any

from fluid_sim_ros.errors import MissingExtraError

#: Shows a table, or writes a result as JSON: (path or None, table, result).
Show = Callable[[str | None, Any, object], None]


def needing_extra(
    function: Callable[[argparse.Namespace, Show], int], arguments: argparse.Namespace, show: Show
) -> int:
    """Run a subcommand; a part that is not installed becomes one line that says what to do."""
    try:
        return function(arguments, show)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith('fluid_sim_ros'):
            raise
        raise MissingExtraError(
            f'{arguments.command} needs {error.name}, which is not installed; '
            'fluid_sim doctor says what to type'
        ) from None
