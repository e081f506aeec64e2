# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Takes the axes of keys and gamepads from the page's script, and steers the chosen vehicle."""

import asyncio
import json
from collections.abc import Callable
from importlib.resources import files
from typing import Any

from websockets.exceptions import ConnectionClosed

from fluid_sim_ros.errors import CommandError, FluidSimError
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.source import Source

#: Longer messages are none of the script's [characters].
_LONGEST = 200


def script() -> str:
    """Return the page's script for keys and gamepads."""
    return (files('fluid_sim_ros.view.web') / 'steer.js').read_text(encoding='utf-8')


def axes_of(text: object, vehicle: str) -> orders.Steer:
    """
    Return what a message of the script asks for.

    Parameters
    ----------
    text
        A JSON list of four numbers: forward, left, up, turn, -1 to 1.
    vehicle
        That is steered.

    Returns
    -------
    Steer
        Checked.

    Raises
    ------
    CommandError
        If it is anything else.

    """
    try:
        values = json.loads(text) if isinstance(text, str) and len(text) <= _LONGEST else None
    except ValueError:
        values = None
    if not isinstance(values, list) or len(values) != 4:
        raise CommandError('steering: the message is no list of four numbers')
    return orders.Steer(vehicle, *values)


class Steering:
    """
    Handles the script's connections.

    Parameters
    ----------
    source
        Takes the orders.
    vehicle
        Returns the name of the vehicle that is steered now.
    say
        Takes a line for the user.

    """

    def __init__(
        self, source: Source, vehicle: Callable[[], str], say: Callable[[str], None]
    ) -> None:
        self._source, self._vehicle, self._say = source, vehicle, say

    async def serve(self, connection: Any) -> None:
        """
        Take messages until the page is closed; then what it steered holds.

        Parameters
        ----------
        connection
            Of the script.

        """
        steered = ''
        try:
            async for text in connection:
                name = self._vehicle()
                if steered not in ('', name):
                    await self._do(orders.Steer(steered))
                try:
                    order = axes_of(text, name)
                except CommandError as error:
                    self._say(str(error))
                    continue
                if steered or any((order.forward, order.left, order.up, order.turn)):
                    steered = name
                    await self._do(order)
        except ConnectionClosed:
            pass
        finally:
            if steered:
                await self._do(orders.Steer(steered))

    async def _do(self, order: orders.Steer) -> None:
        try:
            await asyncio.to_thread(self._source.take, order)
        except FluidSimError as error:
            self._say(str(error))
