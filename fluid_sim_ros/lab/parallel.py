# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Independent runs in threads, one per core; stepping releases Python's lock."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TypeVar

from fluid_sim_ros.output.progress import Report

Item = TypeVar('Item')
Result = TypeVar('Result')


def run_parallel(
    work: Callable[[Item], Result], items: Iterable[Item], what: str, report: Report
) -> list[Result]:
    """
    Apply a function to each item, on all cores; an error or interruption ends all.

    Parameters
    ----------
    work
        The function; it must be safe to call from several threads.
    items
        Its arguments.
    what
        What is being done, for the report.
    report
        Told how far it is.

    Returns
    -------
    list
        What ``work`` returned for each item, in order.

    """
    rows = list(items)
    pool = ThreadPoolExecutor(os.cpu_count())
    try:
        futures = [pool.submit(work, row) for row in rows]
        for done, future in enumerate(as_completed(futures)):
            report(what, done, len(rows))
            future.result()
    finally:
        pool.shutdown(cancel_futures=True)
    report(what, len(rows), len(rows))
    return [future.result() for future in futures]
