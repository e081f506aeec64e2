# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What an advice says: its settings as a scene file has them, and a run that verifies it."""

import math
from typing import Any

from fluid_sim_ros.lab.advisor.advise import scene_problem
from fluid_sim_ros.lab.manoeuvre import judged
from fluid_sim_ros.lab.metrics import metric
from fluid_sim_ros.lab.problems.problem import run_rung
from fluid_sim_ros.scene import Scene


def settings(advice: dict[str, Any]) -> dict[str, Any]:
    """
    Return the keys of a scene file that hold the choice.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    dict
        ``timestep`` [s], ``integrator``, and ``fluid`` unless the choice is the scene's own model.

    """
    choice = advice['choice']
    found = {'timestep': choice['timestep'], 'integrator': choice['integrator']}
    return found if choice['rung'] == 'scene' else found | {'fluid': choice['rung']}


def comment(advice: dict[str, Any]) -> str:
    """
    Return one line on where the choice comes from.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    str
        The command, and the relative error of what it chose.

    """
    return f'{advice["command"]}: error {advice["choice"]["error"]:.2g} ({advice["metric"]})'


def snippet(advice: dict[str, Any]) -> str:
    """
    Return the lines that put the choice in force in the scene's YAML file.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    str
        A comment and the keys of ``settings``.

    """
    lines = [f'{key}: {value}\n' for key, value in settings(advice).items()]
    return ''.join([f'# {comment(advice)}\n', *lines])


def advised(advice: dict[str, Any]) -> dict[str, Any]:
    """
    Return the advised settings that the scene's YAML file can keep.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    dict
        The fields of ``schema.advised.Advised``.

    """
    return {
        'command': advice['command'],
        'tolerance': advice['tolerance'],
        'metric': advice['metric'],
        'error': float(f'{advice["choice"]["error"]:.2g}'),
        **settings(advice),
    }


def verify(scene: str | Scene, advice: dict[str, Any]) -> dict[str, Any]:
    """
    Compare the choice with an independent run: a fourth of its step, on the next richer rung.

    Parameters
    ----------
    scene
        Name, path, or ``Scene``, as it was given to ``advise``.
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    dict
        ``rung`` and ``timestep`` [s] of the independent run, ``fault`` (the watchdog's line, or
        empty), relative ``error`` of the choice against it (None where a run was lost), and
        whether that is ``within`` the tolerance.

    Raises
    ------
    ConfigError
        For a scene that cannot be loaded.

    """
    choice = advice['choice']
    asked = advice.get('asked_duration_s', advice['duration_s'])
    problem = judged(scene_problem(scene, asked, advice['rate_hz']))
    rungs = list(problem.rungs)
    richer = rungs[min(rungs.index(choice['rung']) + 1, len(rungs) - 1)]
    chosen = run_rung(
        problem, problem.rungs[choice['rung']], choice['integrator'], choice['timestep']
    )
    finer = run_rung(problem, problem.rungs[richer], choice['integrator'], choice['timestep'] / 4)
    lost = chosen.fault or finer.fault
    error = math.inf
    if not lost:
        error = metric(advice['metric'], problem, finer.states)(chosen.states, finer.states)
    return {
        'rung': richer, 'timestep': choice['timestep'] / 4, 'fault': lost,
        'error': error if math.isfinite(error) else None, 'within': error <= advice['tolerance'],
    }  # fmt: skip
