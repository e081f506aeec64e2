"""Runs that do not depend on each other, one per core; stepping releases Python's lock."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TypeVar

from fluid_sim_ros.lab.cost import Report

Item = TypeVar('Item')
Result = TypeVar('Result')


def run_parallel(
    work: Callable[[Item], Result], items: Iterable[Item], what: str, report: Report
) -> list[Result]:
    """Return what ``work`` makes of each item, in order; an error or interruption ends all."""
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
