"""The subcommands of ``fluid_sim`` that belong to the laboratory."""

import argparse
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli.lab_tables import advice_table, fronts_table
from fluid_sim_ros.cli.shared import Show, add_command, progress_bar
from fluid_sim_ros.errors import ConfigError

if TYPE_CHECKING:
    from fluid_sim_ros.lab.progress import Report

#: Exit code of advise where nothing meets the tolerance.
NOTHING_FITS = 1
#: Timesteps of a quick chart [s].
_QUICK = (0.02, 0.01, 0.005, 0.002)


def add_parsers(commands: Any, show: Show) -> None:
    """
    Add the subcommands to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """

    def add(name: str, text: str, function: Callable[..., int]) -> argparse.ArgumentParser:
        return add_command(commands, name, text, function, show)

    chart = add('chart', 'chart speed against accuracy of a problem or scene', _chart)
    chart.add_argument(
        'problem', metavar='PROBLEM', nargs='*',
        help='problems or scenes; all: every problem; none: list them',
    )  # fmt: skip
    chart.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/chart'))
    chart.add_argument('--integrators', nargs='+', metavar='NAME', help='default: all five')
    chart.add_argument('--timesteps', nargs='+', type=float, metavar='S', help='[s]')
    chart.add_argument(
        '--rounds', type=int, default=60, help='timed bursts of steps per curve (default 60)'
    )
    chart.add_argument('--quick', action='store_true', help='four timesteps, ten bursts')
    chart.add_argument(
        '--from', dest='saved', nargs='+', type=Path, metavar='JSON',
        help='draw results of an earlier chart again, without running',
    )  # fmt: skip
    chart.add_argument(
        '--time-again', action='store_true',
        help='with --from: measure the times anew, on this machine, and keep the errors',
    )  # fmt: skip
    _add_stability(add('stability', 'map where integration is stable', _stability))
    text = 'find the cheapest fluid model, integrator and timestep for a scene'
    _add_advise(add('advise', text, _advise))


def _add_stability(stability: argparse.ArgumentParser) -> None:
    stability.add_argument(
        'problem', metavar='PROBLEM', nargs='?', help='none: list problems and axes'
    )
    for axis in ('x', 'y'):
        stability.add_argument(f'--{axis}', metavar='AXIS', default='', help='default: its own')
        stability.add_argument(
            f'--{axis}-range', nargs=2, type=float, metavar=('LOW', 'HIGH'), default=()
        )
    stability.add_argument('--cells', type=int, default=24, help='per axis (default 24)')
    stability.add_argument('--integrators', nargs='+', metavar='NAME', help='default: all five')
    stability.add_argument(
        '--set', nargs='+', metavar='AXIS=VALUE', default=[], dest='fixed',
        help='parameters that stay the same over the map',
    )  # fmt: skip
    stability.add_argument(
        '--bisect', action='store_true', help='also find the largest stable timestep at each y'
    )
    stability.add_argument('--restart', action='store_true', help='forget an interrupted run')
    stability.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/stability'))


def _add_advise(advise: argparse.ArgumentParser) -> None:
    advise.add_argument('scene', metavar='SCENE', help='name (fluid_sim scenes) or file')
    advise.add_argument(
        '--tolerance', type=float, required=True, metavar='X',
        help='largest relative error against the converged run of the full model (0.01: 1 %%)',
    )  # fmt: skip
    advise.add_argument('--duration', type=float, metavar='S', help='default: of the scene [s]')
    advise.add_argument(
        '--metric', default='pose', help='pose, position, attitude, velocity or regime'
    )
    advise.add_argument(
        '--rate', type=float, default=100.0, metavar='HZ',
        help='the timestep must divide the period of control and outputs (default 100 Hz)',
    )  # fmt: skip
    advise.add_argument(
        '--budget', type=float, default=50.0, metavar='S',
        help='time for the runs (default 50 s); what it leaves out is said',
    )  # fmt: skip
    advise.add_argument(
        '--apply', action='store_true', help="put the choice in force in the scene's YAML file"
    )
    advise.add_argument(
        '--keep', action='store_true',
        help="write the choice into the scene's YAML file, for fluid_sim run --advised",
    )  # fmt: skip


@contextmanager
def progress() -> Iterator['Report']:
    """
    Give a function that shows how far a measurement is, on standard error.

    Returns
    -------
    context manager
        Gives a function that takes what is done, how many, and of how many.

    """
    with progress_bar('{task.completed}/{task.total}') as bar:
        tasks: dict[str, Any] = {}

        def report(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, visible=done < total)

        yield report


def _chart(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.drawing.chart import draw
    from fluid_sim_ros.lab.drawing.chart_page import write_chart_page

    if arguments.time_again and not arguments.saved:
        raise ConfigError('--time-again: needs --from JSON, the charts to time')
    if arguments.saved:
        found = [results.load(path, 'points') for path in arguments.saved]
        if arguments.time_again:
            found = _timed_again(found, 10 if arguments.quick else arguments.rounds)
    elif arguments.problem:
        found = _measured(arguments)
    else:
        return _list_problems(arguments, show)
    folder: Path = arguments.out
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for result in found:
        stem = folder / result['problem']
        files += [
            results.save(result, stem.with_suffix('.json')),
            results.write_csv(result, stem.with_suffix('.csv')),
            draw(result, stem.with_suffix('.png')),
        ]
    files.append(write_chart_page(found, folder / 'chart.html'))
    show(
        arguments.json,
        fronts_table(found, files),
        {'charts': found, 'files': [str(file) for file in files]},
    )
    return 0


def _measured(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    from fluid_sim_ros.lab.charts.measure import measure
    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS, problem
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS

    names = list(PROBLEMS) if arguments.problem == ['all'] else arguments.problem
    problems = [problem(name) for name in names]
    with progress() as report:
        return [
            measure(
                each,
                integrators=arguments.integrators or INTEGRATORS,
                timesteps=arguments.timesteps or (_QUICK if arguments.quick else ()),
                rounds=10 if arguments.quick else arguments.rounds,
                report=report,
            )
            for each in problems
        ]


def _timed_again(found: list[dict[str, Any]], rounds: int) -> list[dict[str, Any]]:
    from fluid_sim_ros.lab.charts.measure import time_again
    from fluid_sim_ros.lab.problems.catalogue import problem

    with progress() as report:
        return [
            time_again(each, problem(each['problem']), rounds=rounds, report=report)
            for each in found
        ]


def _stability(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.drawing.stability_chart import draw_map
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS
    from fluid_sim_ros.lab.stability.limits import largest_steps
    from fluid_sim_ros.lab.stability.outcomes import OUTCOMES
    from fluid_sim_ros.lab.stability.stability_map import plan, run_map

    if not arguments.problem:
        return _list_stability(arguments, show)
    head = plan(
        arguments.problem, x=arguments.x, y=arguments.y, x_range=arguments.x_range,
        y_range=arguments.y_range, cells=arguments.cells,
        integrators=arguments.integrators or INTEGRATORS, fixed=_settings(arguments.fixed),
    )  # fmt: skip
    stem = arguments.out / f'{head["problem"]}_{head["x"]}_{head["y"]}'
    with progress() as report:
        result = run_map(
            head, stem.with_suffix('.jsonl'), restart=arguments.restart, report=report
        )
        if arguments.bisect:
            result['largest_steps'] = largest_steps(head, report)
    result['files'] = [str(stem.with_suffix(suffix)) for suffix in ('.jsonl', '.json', '.png')]
    draw_map(result, stem.with_suffix('.png'))
    results.save(result, stem.with_suffix('.json'))
    table = Table('integrator', *OUTCOMES, title=f'{head["problem"]}: cells by outcome')
    for integrator in head['integrators']:
        words = [row['outcome'] for row in result['map'] if row['integrator'] == integrator]
        table.add_row(integrator, *(str(words.count(word)) for word in OUTCOMES))
    show(arguments.json, Group(table, escape('\n'.join(result['files']))), result)
    return 0


def _settings(pairs: list[str]) -> dict[str, float]:
    """Return AXIS=VALUE pairs as numbers."""
    out = {}
    for pair in pairs:
        name, _, value = pair.partition('=')
        try:
            out[name] = float(value)
        except ValueError:
            raise ConfigError(f"--set '{pair}': must be AXIS=NUMBER") from None
        if not math.isfinite(out[name]):
            raise ConfigError(f"--set '{pair}': must be finite")
    return out


def _advise(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab.advisor import advice as lab
    from fluid_sim_ros.lab.advisor.advise import advise
    from fluid_sim_ros.lab.advisor.scene_settings import apply, keep, scene_file

    if arguments.apply or arguments.keep:
        scene_file(arguments.scene)
    with progress() as report:
        advice = advise(
            arguments.scene, arguments.tolerance, duration=arguments.duration,
            metric_name=arguments.metric, rate=arguments.rate, budget=arguments.budget,
            report=report,
        )  # fmt: skip
    written = []
    if arguments.keep and advice['choice']:
        written.append(keep(arguments.scene, lab.advised(advice)))
    if arguments.apply and advice['choice']:
        written.append(apply(arguments.scene, lab.settings(advice), lab.comment(advice)))
    advice['written'] = [str(path) for path in written]
    show(arguments.json, advice_table(advice, arguments.metric), advice)
    return 0 if advice['choice'] else NOTHING_FITS


def _list_stability(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.table import Table

    from fluid_sim_ros.lab.problems.bodies import AXES, FAMILIES

    problems = Table('problem', 'what coasts', 'x', 'y', title='Stability problems')
    for name, kind in FAMILIES.items():
        problems.add_row(name, kind.title, kind.x, kind.y)
    axes = Table('axis', 'meaning', 'range', title='Axes')
    for name, axis in AXES.items():
        axes.add_row(name, axis.label.replace('[', r'\['), f'{axis.low:g} to {axis.high:g}')
    result = {
        'problems': {name: kind.title for name, kind in FAMILIES.items()},
        'axes': {name: axis.label for name, axis in AXES.items()},
    }
    show(arguments.json, Group(problems, axes), result)
    return 0


def _list_problems(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS

    table = Table('problem', 'what moves', 'stands for', title='Problems (every scene is one too)')
    rows = []
    for name, make in PROBLEMS.items():
        each = make()
        rows.append({'name': name, 'title': each.title, 'stands_for': each.stands_for})
        table.add_row(name, escape(each.title), escape(each.stands_for))
    show(arguments.json, table, rows)
    return 0
