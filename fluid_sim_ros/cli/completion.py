# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Completes the words of ``fluid_sim`` in a shell, by argcomplete; ``fluid_sim completion``."""

import argparse
import os
from collections.abc import Callable, Iterable
from typing import Any

SHELLS = ('bash', 'zsh', 'fish')
#: Integrators and rungs as people write them; here, because MuJoCo takes its time to load.
INTEGRATORS = ('Euler', 'RK4', 'implicit', 'implicitfast', 'discrete')
FLUIDS = ('none', 'inertia', 'ellipsoid', 'no_added_mass', 'inflow')

Completer = Callable[..., Iterable[str]]


#: Suffixes of meshes, and of logs of flights.
MESHES = ('stl', 'obj', 'ply', 'glb', 'dae')
FLIGHTS = ('mcap', 'ulg', 'bin', 'BIN', 'log', 'db3', 'csv', 'parquet')


def complete(parser: argparse.ArgumentParser) -> None:
    """
    Answer a shell that asks for words, and end; else return at once.

    Parameters
    ----------
    parser
        Of the whole command line.

    """
    if '_ARGCOMPLETE' in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser, always_complete_options=False)


def completed_by(action: argparse.Action, completer: Completer) -> None:
    """
    Have an argument completed.

    Parameters
    ----------
    action
        Of the argument.
    completer
        Takes the prefix, and more by name; returns words.

    """
    action.completer = completer  # type: ignore[attr-defined]  # where argcomplete looks


def shell_code(shell: str) -> str:
    """
    Return what a shell must run so that it completes ``fluid_sim``.

    Parameters
    ----------
    shell
        One of SHELLS.

    """
    from argcomplete.shell_integration import shellcode

    return str(shellcode(['fluid_sim'], shell=shell))


def files(*suffixes: str) -> Completer:
    """
    Return a completer of files and folders.

    Parameters
    ----------
    *suffixes
        Of the files, without a dot.

    """

    def find(prefix: str, **_: Any) -> list[str]:
        from argcomplete.completers import FilesCompleter

        return list(FilesCompleter(suffixes)(prefix))

    return find


def scenes(prefix: str, **_: Any) -> list[str]:
    """
    Return scenes, and the files of models and scenes.

    Parameters
    ----------
    prefix
        What is typed already.

    """
    from fluid_sim_ros.resources import config_folder, models_folder

    # as scene.scene_names, which takes half a second to import
    names = {path.stem for path in (config_folder() / 'scenes').glob('*.yaml')}
    names |= {path.stem for path in models_folder().glob('*.xml')}
    fitting = sorted(name for name in names if name.startswith(prefix))
    return [*fitting, *files('xml', 'mjcf', 'yaml', 'yml')(prefix)]


def problems(prefix: str, **_: Any) -> list[str]:
    """
    Return the laboratory's problems, and scenes.

    Parameters
    ----------
    prefix
        What is typed already.

    """
    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS

    return [*(name for name in PROBLEMS if name.startswith(prefix)), *scenes(prefix)]


def stability_problems(prefix: str, **_: Any) -> list[str]:
    """
    Return the problems of ``fluid_sim stability``, and scenes.

    Parameters
    ----------
    prefix
        What is typed already.

    """
    from fluid_sim_ros.lab.problems.bodies import FAMILIES

    return [*(name for name in FAMILIES if name.startswith(prefix)), *scenes(prefix)]


def words(*known: str) -> Completer:
    """
    Return a completer of a fixed list.

    Parameters
    ----------
    *known
        The words.

    """
    return lambda prefix, **_: [word for word in known if word.startswith(prefix)]
