"""The subcommand ``fluid_sim view``: a live view of a scene in the browser."""

import argparse
import threading
import webbrowser
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import at_least
from fluid_sim_ros.cli.shared import Show, add_command, add_scene, plain_lines, plain_text
from fluid_sim_ros.errors import ConfigError, needed_for
from fluid_sim_ros.interruption import stopped_by_signals

_PORT, _MOST_PORT = 8080, 65535


def add_parser(commands: Any, show: Show) -> None:
    """
    Add the subcommand to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'see a scene move in the browser, with the forces as arrows, and steer it'
    view = add_command(commands, 'view', text, _view, show)
    add_scene(view)
    view.add_argument(
        '--host', default='127.0.0.1', metavar='ADDRESS',
        help='where the page is served (default 127.0.0.1: this machine alone); for any other the '
        'address of the page holds a token',
    )  # fmt: skip
    view.add_argument(
        '--port', type=at_least(0, int), default=_PORT, metavar='N',
        help=f'of the page (default {_PORT}); 0: one that is free',
    )  # fmt: skip
    view.add_argument('--open', action='store_true', help='open the page in the browser')
    view.add_argument(
        '--pace', type=at_least(0), default=1.0, metavar='X',
        help='simulated seconds per second, 0.1 to 50 (default 1); 0: as fast as it goes',
    )  # fmt: skip
    view.add_argument('--paused', action='store_true', help='begin paused')
    view.add_argument(
        '--no-hold', action='store_true',
        help='leave vehicles to the sliders; by default those that the scene does not command are '
        'held where they begin, and follow the keys',
    )  # fmt: skip
    view.add_argument(
        '--end-after', type=at_least(0), metavar='S', help='end by itself [s of wall time]'
    )
    view.add_argument('--timestep', type=float, metavar='S', help="replaces the model's [s]")
    completion.completed_by(
        view.add_argument('--integrator', metavar='NAME', help=', '.join(completion.INTEGRATORS)),
        completion.words(*completion.INTEGRATORS),
    )
    completion.completed_by(
        view.add_argument('--fluid', metavar='MODEL', help=', '.join(completion.FLUIDS)),
        completion.words(*completion.FLUIDS),
    )
    view.add_argument('--seed', type=int, default=0, help='of everything random (default 0)')


def _view(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.output.plain_console import PlainConsole
    from fluid_sim_ros.schema.settings import RunSettings
    from fluid_sim_ros.view.orders import Pace
    from fluid_sim_ros.view.simulated import SimulatedSource, ViewOptions

    if arguments.port > _MOST_PORT:
        raise ConfigError(f'--port {arguments.port}: allowed is 0 to {_MOST_PORT}')
    say = plain_lines(PlainConsole(stderr=True))
    settings = RunSettings.checked(
        '--{}', **{key: getattr(arguments, key) for key in RunSettings.model_fields}
    )
    Pace(arguments.pace)  # refused before anything is opened
    options = ViewOptions(arguments.pace, not arguments.no_hold, arguments.paused)
    source = SimulatedSource(arguments.scene, settings, options, say)
    with needed_for('view'):
        from fluid_sim_ros.view.web.page import Page
    page = Page(source, arguments.host, int(arguments.port), say)
    say(f'{page.url}  (Ctrl-C ends it)')
    timer = threading.Timer(arguments.end_after or 0.0, source.stop)
    try:
        with stopped_by_signals(source.stop) as interruption:
            page.start()
            if arguments.open and not webbrowser.open(page.url):
                say('no browser could be opened here; open the address above')
            if arguments.end_after is not None:
                timer.start()
            source.run()
    finally:
        timer.cancel()
        page.close()
    result = {
        'scene': source.title, 'url': page.url, 'pictures': page.drawn,
        'duration_s': source.simulation.time, 'interrupted': interruption.name,
    }  # fmt: skip
    lines = [f'{source.title}: {source.simulation.time:.2f} s, {page.drawn} pictures']
    show(arguments.json, plain_text(lines), result)
    return 0
