# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommand ``fluid_sim view``: a scene, a log or a node in the browser."""

import argparse
import threading
import webbrowser
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import at_least
from fluid_sim_ros.cli.shared import Show, add_command, add_scene, plain_lines, plain_text
from fluid_sim_ros.errors import ConfigError, needed_for
from fluid_sim_ros.interruption import stopped_by_signals
from fluid_sim_ros.output.progress import LOG_PATIENCE, progress_of_parts, silent

if TYPE_CHECKING:
    from fluid_sim_ros.view.source import Source

_PORT, _MOST_PORT, _NODE = 8080, 65535, '/fluid_sim_node'


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
    text = 'see a scene, a log or a node in the browser, with its forces as arrows, and steer it'
    view = add_command(commands, 'view', text, _view, show)
    add_scene(
        view, nargs='?', help='name (fluid_sim scenes), MJCF or YAML file, or a log (.mcap, a bag)'
    )
    view.add_argument(
        '--node', nargs='?', const=_NODE, metavar='NAME',
        help=f'show a running node (default {_NODE}); SCENE: in place of the one that it names',
    )  # fmt: skip
    view.add_argument(
        '--with', action='append', default=[], metavar='KEY=VALUE', dest='changes',
        help='of a log: show the flight with a change beside it, pale (see fluid_sim replay)',
    )  # fmt: skip
    view.add_argument(
        '--host', default='127.0.0.1', metavar='ADDRESS',
        help='where the page is served (default 127.0.0.1: this machine alone); for any other the '
        'address of the page holds a token',
    )  # fmt: skip
    view.add_argument(
        '--port', type=at_least(0, int), default=_PORT, metavar='N',
        help=f'of the page (default {_PORT}); 0: one that is free',
    )  # fmt: skip
    view.add_argument(
        '--native', action='store_true',
        help="MuJoCo's desktop viewer with the arrows, in place of the page",
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
    from fluid_sim_ros.view.orders import Pace

    if arguments.port > _MOST_PORT:
        raise ConfigError(f'--port {arguments.port}: allowed is 0 to {_MOST_PORT}')
    Pace(arguments.pace)  # refused before anything is opened
    say = plain_lines(PlainConsole(stderr=True))
    with ExitStack() as stack:
        source = _source(arguments, say, stack)
        return (_show_natively if arguments.native else _serve)(source, arguments, say, show)


def _show_natively(
    source: 'Source', arguments: argparse.Namespace, say: Callable[[str], None], show: Show
) -> int:
    """Show the source in MuJoCo's desktop viewer until it ends; return the exit code."""
    from fluid_sim_ros.view.native import NativeView

    view = NativeView(source)
    say('Space pauses, right arrow steps, Backspace resets; the window or Ctrl-C ends it')
    view.start()
    try:
        interruption = _run(source, arguments)
    finally:
        view.close()
    return _tell(source, arguments, show, {
        'pictures': view.drawn, 'arrows': view.arrows, 'interrupted': interruption,
    })  # fmt: skip


def _serve(
    source: 'Source', arguments: argparse.Namespace, say: Callable[[str], None], show: Show
) -> int:
    """Serve the page until the source ends; return the exit code."""
    with needed_for('view'):
        from fluid_sim_ros.view.web.page import Page

    page = Page(source, arguments.host, int(arguments.port), say)
    say(f'{page.url}  (Ctrl-C ends it)')
    try:
        page.start()
        if arguments.open and not webbrowser.open(page.url):
            say('no browser could be opened here; open the address above')
        interruption = _run(source, arguments)
    finally:
        page.close()
    return _tell(source, arguments, show, {
        'url': page.url, 'pictures': page.drawn, 'interrupted': interruption,
    })  # fmt: skip


def _run(source: 'Source', arguments: argparse.Namespace) -> str:
    """Run a source to its end; return the signal that ended it, or nothing."""
    timer = threading.Timer(arguments.end_after or 0.0, source.stop)
    try:
        with stopped_by_signals() as interruption:
            interruption.stops(source.stop)
            if arguments.end_after is not None:
                timer.start()
            source.run()
    finally:
        timer.cancel()
    return interruption.name


def _tell(
    source: 'Source', arguments: argparse.Namespace, show: Show, seen: dict[str, Any]
) -> int:
    frame = source.frame()
    result = {'shown': source.title, 'time_s': 0.0 if frame is None else frame.time, **seen}
    lines = [f'{source.title}: {result["time_s"]:.2f} s, {seen["pictures"]} pictures']
    show(arguments.json, plain_text(lines), result)
    return 0


def _source(
    arguments: argparse.Namespace, say: Callable[[str], None], stack: ExitStack
) -> 'Source':
    """Return what is shown: a node, a log, or a scene."""
    from fluid_sim_ros.schema.settings import RunSettings

    given = {key: getattr(arguments, key) for key in RunSettings.model_fields}
    settings = RunSettings.checked('--{}', **given)
    if arguments.node is not None:
        return _node(arguments, given, say, stack)
    if arguments.scene is None:
        raise ConfigError('view needs a SCENE, a LOG or --node')
    path = Path(arguments.scene)
    if path.suffix == '.mcap' or path.is_dir():
        return _log(arguments, path, given, say)
    if arguments.changes:
        raise ConfigError('--with is for a log: the flight with a change beside the recorded one')
    from fluid_sim_ros.view.simulated import SimulatedSource, ViewOptions

    options = ViewOptions(arguments.pace, not arguments.no_hold, arguments.paused)
    return SimulatedSource(arguments.scene, settings, options, say)


def _only_for_scenes(
    arguments: argparse.Namespace, given: dict[str, Any], others: Sequence[str], instead: str
) -> None:
    """Refuse options that only a scene can heed."""
    for key in (*given, 'no_hold', *others):
        if getattr(arguments, key):
            option = {'changes': 'with'}.get(key, key).replace('_', '-')
            raise ConfigError(f'--{option} does not go with it; {instead}')


def _node(
    arguments: argparse.Namespace,
    given: dict[str, Any],
    say: Callable[[str], None],
    stack: ExitStack,
) -> 'Source':
    with needed_for('--node'):
        from fluid_sim_ros.cli.view.node_link import linked
        from fluid_sim_ros.cli.view.node_source import NodeSource
    _only_for_scenes(arguments, given, ('changes', 'paused'), 'a node has its own parameters')
    return NodeSource(stack.enter_context(linked(arguments.node)), arguments.scene or '', say)


def _log(
    arguments: argparse.Namespace, path: Path, given: dict[str, Any], say: Callable[[str], None]
) -> 'Source':
    from fluid_sim_ros.cli.view.log_source import LogSource
    from fluid_sim_ros.recording.reader import open_log

    _only_for_scenes(arguments, given, (), 'a log was flown; --with shows it with a change')
    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(path, report)
        for fault in log.faults:
            say(f'damaged: {fault}')
        source = LogSource(log, arguments.changes, arguments.pace, arguments.paused, say)
    log.report = silent  # what is read later, nobody waits for
    return source
