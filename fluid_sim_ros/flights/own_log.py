# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a log of fluid_sim says besides its messages: commands that its scene scheduled."""

import json
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.flights.flight import Stream
from fluid_sim_ros.schema.limits import limit

#: Attachment with the scene that was run.
_RUN = 'fluid_sim/run.json'
#: Commands that push a vehicle past its thrusters, or through an allocation: not repeated here.
_UNREPEATED = ('cmd/wrench', 'cmd/wrench_allocated', 'cmd/joints')


def run_of(file: Path) -> Mapping[str, Any] | None:
    """
    Return what an MCAP file says of the run that it is of.

    Parameters
    ----------
    file
        Of the log.

    Returns
    -------
    dict
        As in ``run.json``; None for a log of other software, one whose thrust commands are not in
        newton, or a damaged one.

    """
    from mcap.exceptions import McapError
    from mcap.reader import make_reader

    try:
        with file.open('rb') as stream:
            reader = make_reader(stream)
            about = {each.name: each.metadata for each in reader.iter_metadata()}
            unit = about.get('parameters', {}).get('thrust.unit', 'newton')
            if 'fluid_sim' not in about or 'newton' not in unit:
                return None
            for each in reader.iter_attachments():
                if each.name == _RUN and len(each.data) < limit('flight_bytes'):
                    found = json.loads(each.data)
                    return found if isinstance(found, dict) else None
    except (McapError, struct.error, ValueError, KeyError, OSError, EOFError, AttributeError):
        return None
    return None


def with_schedule(
    streams: Mapping[str, Stream], run: Mapping[str, Any]
) -> tuple[dict[str, Stream], tuple[str, ...]]:
    """
    Return streams with the thrusts that the scene commanded by itself, and what is not repeated.

    Parameters
    ----------
    streams
        By topic.
    run
        As ``run_of`` returns it.

    Returns
    -------
    streams, faults
        ``NAME/cmd/thrust`` holds commands of topics and of the schedule, in order of time.

    """
    out = dict(streams)
    rows: dict[str, list[tuple[float, list[float]]]] = {}
    try:
        for event in run['scene']['schedule']:
            for vehicle, values in (event.get('thrust') or {}).items():
                row = [float(value) for value in values]
                rows.setdefault(str(vehicle), []).append((float(event['at']), row))
    except (KeyError, TypeError, ValueError, AttributeError):
        rows = {}
    for vehicle, planned in rows.items():
        topic = f'/{vehicle}/cmd/thrust'
        size = len(planned[0][1])
        times = np.array([time for time, _ in planned])
        table = np.array([row for _, row in planned if len(row) == size])
        if len(table) != len(times):
            continue
        given = out.get(topic)
        if given is not None:
            said = np.stack([given.columns.get(f'data[{i}]', np.full(len(given.times), np.nan))
                             for i in range(size)], axis=1)  # fmt: skip
            times, table = np.concatenate([times, given.times]), np.concatenate([table, said])
            order = np.argsort(times, kind='stable')
            last = np.append(np.diff(times[order]) > 0, True)  # of several at once the last
            times, table = times[order][last], table[order][last]
        out[topic] = Stream(times, {f'data[{i}]': table[:, i] for i in range(size)})
    faults = [
        f'{topic}: {len(stream.times)} commands that a comparison does not repeat'
        for topic, stream in out.items()
        if topic.endswith(_UNREPEATED) and len(stream.times)
    ]
    if any('allocated' in line for line in faults):  # thrusts that no topic holds
        out = {t: s for t, s in out.items() if not t.endswith('/cmd/thrust')}
    return out, tuple(faults)
