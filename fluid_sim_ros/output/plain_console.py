# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A console on which no text of a file acts: control characters are shown, not sent."""

from collections.abc import Iterator
from typing import Any, NoReturn

from rich.console import Console
from rich.segment import Segment

from fluid_sim_ros.errors import printable


class PlainConsole(Console):
    """A console of rich whose texts lose what a terminal would act on; colours are its own."""

    def on_broken_pipe(self) -> NoReturn:
        """Leave it to the program what to do where nobody reads its output any more."""
        raise

    def render(self, *arguments: Any, **options: Any) -> Iterator[Segment]:
        """
        Yield the segments of something to show.

        Parameters
        ----------
        *arguments, **options
            Of ``rich.console.Console.render``.

        Yields
        ------
        Segment
            A piece of text with its style.

        """
        for segment in super().render(*arguments, **options):
            if segment.control or segment.text.replace('\n', '').isprintable():
                yield segment
                continue
            lines = segment.text.split('\n')
            text = '\n'.join(printable(line, len(line)) for line in lines)
            yield Segment(text, segment.style, segment.control)
