# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The recording of a run without ROS."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.errors import needed_for
from fluid_sim_ros.loop.runner import Sink
from fluid_sim_ros.simulation import Simulation

if TYPE_CHECKING:
    from fluid_sim_ros.recording.sink import RecordingSink


def watch(log: 'RecordingSink | None', say: Callable[[str], None]) -> Callable[[], None]:
    """
    Return what says, once, that the recording has stopped while the flight goes on.

    Parameters
    ----------
    log
        The recording, or None.
    say
        Takes the line.

    Returns
    -------
    Callable
        Called at every turn of the loop.

    """
    said = False

    def look() -> None:
        nonlocal said
        if log is not None and log.recorder.fault and not said:
            said = True
            say(f'warning: {log.recorder.fault}; going on without')

    return look


@contextmanager
def recorded(
    simulation: Simulation,
    path: str | Path | None,
    topics: Sequence[str],
    folders: Sequence[Path],
    sinks: list[Sink],
) -> Iterator[tuple[dict[str, Any], 'RecordingSink | None']]:
    """
    Record a run where that is asked for.

    Parameters
    ----------
    simulation
        At step 0.
    path
        Of the log; None: there is none.
    topics
        Patterns of relative topic names.
    folders
        As ``RecorderOptions.allow_assets_from``.
    sinks
        Gets the one that records.

    Returns
    -------
    context manager
        Of what the result says of the log, complete behind the block, and the sink or None.

    Raises
    ------
    ConfigError, MissingExtraError
        If the log cannot be made.

    """
    if path is None:
        yield {}, None
        return
    with needed_for('--record'):
        from fluid_sim_ros.recording.sink import RecordingSink
    settings = {'fluid': simulation.settings.fluid or ''}
    sink = RecordingSink(simulation, Path(path), settings, topics, folders)
    sinks.append(sink)
    files: dict[str, Any] = {'record': str(sink.recorder.paths[0])}
    try:
        yield files, sink
    finally:
        sink.close()
        files['records'] = [str(path) for path in sink.recorder.paths]
        files['record_fault'] = sink.recorder.fault
