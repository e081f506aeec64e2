"""Hands the runs of a sweep to threads of this machine, or to Ray."""

import logging
import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.lab.sweep.flight import Flights, Row
from fluid_sim_ros.lab.sweep.results import Results, statistics
from fluid_sim_ros.lab.sweep.sweep_file import SweepFile, as_plain

#: Most runs that are lost with a killed process, and least portions per worker.
_LARGEST_PORTION, _PORTIONS_PER_WORKER = 256, 8

Portion = tuple[int, int]
#: Told of each finished portion: runs done so far, and runs in all.
Report = Callable[[int, int], None]


def conduct(
    sweep: SweepFile,
    out: Path,
    *,
    workers: int | None = None,
    ray_address: str | None = None,
    report: Report = lambda done, total: None,
) -> dict[str, Any]:
    """
    Run a sweep to its end; what an earlier try left in ``out`` is kept.

    A run's numbers depend on its index only, so the rows are the same bits whoever flies them.

    Parameters
    ----------
    sweep
        What is run.
    out
        Folder of the results.
    workers
        Threads, or Ray workers; default: one per core.
    ray_address
        ``local`` starts Ray on this machine; else the address of a cluster on which this package
        is installed. None: threads.
    report
        Called after each portion.

    Returns
    -------
    dict
        Numbers of runs, wall time, how the runs ended, and the range of each column.

    Raises
    ------
    ConfigError, MissingExtraError
        If the sweep does not fit its scene, ``out`` holds another one, or Ray is not there.

    """
    if workers is not None and workers < 1:
        raise ConfigError(f'--workers {workers}: must be 1 or more')
    workers = workers or os.cpu_count() or 1
    flights = Flights(sweep)
    flights.check()
    total = len(flights.cases)
    size = max(1, min(_LARGEST_PORTION, total // (workers * _PORTIONS_PER_WORKER)))
    portions = [(begin, min(begin + size, total)) for begin in range(0, total, size)]
    results = Results(out, sweep)
    left = [portion for portion in portions if not results.has(*portion)]
    kept = done = total - sum(end - begin for begin, end in left)
    report(done, total)
    start = time.perf_counter()
    finished = (
        _on_threads(sweep, left, workers)
        if ray_address is None
        else _on_ray(sweep, left, workers, ray_address)
    )
    for (begin, end), rows in finished:
        results.add(begin, rows)
        done += end - begin
        report(done, total)
    wall = time.perf_counter() - start
    table = results.finish([begin for begin, _ in portions])
    return {
        'scene': sweep.scene,
        'runs': total,
        'runs_kept_from_before': kept,
        'workers': workers,
        'wall_s': wall,
        'table': str(results.table_path),
        **statistics(table),
    }


def _on_threads(
    sweep: SweepFile, portions: Sequence[Portion], workers: int
) -> Iterator[tuple[Portion, list[Row]]]:
    """
    Fly portions in threads; stepping releases Python's lock, so they run side by side.

    ``mujoco.rollout`` would not do: it knows neither the schedule of a scene nor the watch after
    each step.
    """
    own = threading.local()

    def fly(portion: Portion) -> list[Row]:
        if not hasattr(own, 'flights'):
            own.flights = Flights(sweep)
        rows: list[Row] = own.flights.rows(*portion)
        return rows

    pool = ThreadPoolExecutor(workers)
    try:
        futures = {pool.submit(fly, portion): portion for portion in portions}
        for future in as_completed(futures):
            yield futures.pop(future), future.result()
    finally:
        pool.shutdown(cancel_futures=True)


#: The sweep that a Ray worker runs, ready to fly: key and flights.
_worker: dict[str, Flights] = {}


def _fly_remotely(plain: dict[str, Any], portion: Portion) -> list[Row]:
    key = repr(plain)
    if key not in _worker:
        _worker.clear()
        _worker[key] = Flights(SweepFile.model_validate(plain))
    return _worker[key].rows(*portion)


def _on_ray(
    sweep: SweepFile, portions: Sequence[Portion], workers: int, address: str
) -> Iterator[tuple[Portion, list[Row]]]:
    """Fly portions on a Ray cluster, which repeats those of a worker that dies."""
    try:
        import ray
    except ModuleNotFoundError:
        raise MissingExtraError(
            '--ray needs ray, which is not installed; type: pip install "fluid_sim_ros[sweep]"'
        ) from None
    local = address == 'local'
    try:
        ray.init(
            address='local' if local else address, num_cpus=workers if local else None,
            include_dashboard=False if local else None, log_to_driver=False,
            logging_level=logging.ERROR,
        )  # fmt: skip
    except (ConnectionError, ValueError) as error:
        raise ConfigError(f"--ray '{address}': {str(error).splitlines()[0]}") from None
    try:
        fly = ray.remote(max_retries=3)(_fly_remotely)
        plain = as_plain(sweep)
        flying: dict[Any, Portion] = {}
        for portion in portions:
            flying[fly.remote(plain, portion)] = portion
            if len(flying) >= 2 * workers:
                yield from _first(ray, flying)
        while flying:
            yield from _first(ray, flying)
    finally:
        ray.shutdown()


def _first(ray: Any, flying: dict[Any, Portion]) -> Iterable[tuple[Portion, list[Row]]]:
    """Yield the portion that is ready first."""
    (ready,), _ = ray.wait(list(flying), num_returns=1)
    yield flying.pop(ready), ray.get(ready)
