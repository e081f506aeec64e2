# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What panels share: events of a browser become calls, what is wrong with them a line."""

from collections.abc import Callable
from typing import Any

from fluid_sim_ros.errors import FluidSimError, printable
from fluid_sim_ros.view.orders import number


def on_user(
    handle: Any, act: Callable[[Any], None], say: Callable[[str], None], click: bool = False
) -> Any:
    """
    Call a function with the value of a control when a user, not this program, has changed it.

    Parameters
    ----------
    handle
        Of the control.
    act
        Takes the value, as it came from the browser.
    say
        Takes a line: what was refused, and why.
    click
        Whether it is a button.

    Returns
    -------
    object
        The handle.

    """

    def react(event: Any) -> None:
        if not click and event.client_id is None:
            return
        try:
            act(event.target.value)
        except FluidSimError as error:
            say(str(error))
        except (TypeError, ValueError, OverflowError):
            say(f'{event.target.value!r} is not a value for it')

    (handle.on_click if click else handle.on_update)(react)
    return handle


def checked(value: Any) -> float:
    """
    Return a number that a browser sent.

    Parameters
    ----------
    value
        Whatever came.

    Returns
    -------
    float
        Finite.

    """
    return number(value, 'value')


def one_of(names: tuple[str, ...], name: Any) -> str:
    """
    Return a choice that a browser sent.

    Parameters
    ----------
    names
        That were offered.
    name
        Whatever came.

    Returns
    -------
    str
        One of the names.

    Raises
    ------
    FluidSimError
        If it is none of them.

    """
    if name not in names:
        raise FluidSimError(f'{name!r} is none of the choices')
    return str(name)


def html(text: str) -> str:
    """
    Return a text as HTML that shows it as it is.

    Parameters
    ----------
    text
        Any.

    """
    safe = printable(text, 300)
    return safe.replace('&', '&amp;').replace('<', '&lt;').replace('>', '&gt;')


def boxed(content: str) -> str:
    """
    Return HTML with the margins of a panel.

    Parameters
    ----------
    content
        HTML.

    """
    return f'<div style="padding:0.3em 1em;font-size:0.85em">{content}</div>'
