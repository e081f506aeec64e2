# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs the portions of a sweep: on threads of this machine, or on workers of Ray."""

import logging
import os
import socket
import threading
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.interruption import held
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.compiled_run import Row
from fluid_sim_ros.sweep.results import Portion
from fluid_sim_ros.sweep.sweep_file import SweepFile, as_plain

#: How long an address may take to answer [s].
_ANSWER_S = 5.0


def on_threads(sweep: SweepFile, portions: Sequence[Portion], workers: int) -> Iterator[list[Row]]:
    """
    Run portions in threads; stepping releases Python's lock, so they run side by side.

    ``mujoco.rollout`` and ``mujoco.batch`` would not do for all: they know neither the schedule
    and gaits of a scene nor a controller nor the watch after each step. For runs that need none of
    this ``simulation.batch.BatchRuns`` does the same, and leaves little to gain.

    Parameters
    ----------
    sweep
        What is run.
    portions
        Runs that are left.
    workers
        Number of threads.

    Yields
    ------
    rows
        The rows of each portion, as they come.

    """
    own = threading.local()

    def run_portion(portion: Portion) -> list[Row]:
        if not hasattr(own, 'runner'):
            own.runner = CaseRunner(sweep)
        rows: list[Row] = own.runner.rows(*portion)
        return rows

    pool = ThreadPoolExecutor(workers)
    try:
        futures = [pool.submit(run_portion, portion) for portion in portions]
        for future in as_completed(futures):
            yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)


#: The sweep that a Ray worker runs, ready to run: key and runner.
_worker: dict[str, CaseRunner] = {}


def _run_remotely(plain: dict[str, Any], portion: Portion) -> list[Row]:
    key = repr(plain)
    if key not in _worker:
        _worker.clear()
        _worker[key] = CaseRunner(SweepFile.model_validate(plain))
    return _worker[key].rows(*portion)


def on_ray(
    sweep: SweepFile, portions: Sequence[Portion], workers: int, address: str
) -> Iterator[list[Row]]:
    """
    Run portions on a Ray cluster, which repeats those of a worker that dies.

    Parameters
    ----------
    sweep
        What is run.
    portions
        Runs that are left.
    workers
        Number of processes.
    address
        ``local``, or the address of a cluster.

    Yields
    ------
    rows
        The rows of each portion, as they come.

    Raises
    ------
    ConfigError, MissingExtraError
        If there is no cluster at the address, or no Ray here.

    """
    try:
        with held(from_library=True):
            import ray
    except ModuleNotFoundError:
        raise MissingExtraError(
            '--ray needs ray, which is not installed; type: pip install "fluid_sim_ros[sweep]"'
        ) from None
    local = address == 'local'
    if not local:
        _check_address(address)
    if local:
        _stay_on_this_host()
    try:
        try:
            with held(from_library=True):
                ray.init(
                    address='local' if local else address, num_cpus=workers if local else None,
                    include_dashboard=False if local else None, log_to_driver=False,
                    logging_level=logging.ERROR,
                )  # fmt: skip
        except (ConnectionError, ValueError) as error:
            raise ConfigError(f"--ray '{address}': {str(error).splitlines()[0]}") from None
        remote = ray.remote(max_retries=3)(_run_remotely)
        plain = as_plain(sweep)
        under_way: set[Any] = set()
        for portion in portions:
            under_way.add(remote.remote(plain, portion))
            if len(under_way) >= 2 * workers:
                yield from _first(ray, under_way)
        while under_way:
            yield from _first(ray, under_way)
    finally:
        ray.shutdown()


def _stay_on_this_host() -> None:
    """
    Have a Ray that is started here listen on 127.0.0.1 alone, and send no statistics.

    It replaces ``_node_ip_address='127.0.0.1'`` by an address of the network, except where it
    knows no clusters, as on Windows. So it is told that it knows none.
    """
    from ray._private import ray_constants

    os.environ.setdefault('RAY_USAGE_STATS_ENABLED', '0')
    ray_constants.ENABLE_RAY_CLUSTER = False


def _check_address(address: str) -> None:
    """Refuse an address where nothing answers: Ray itself would try for minutes."""
    if address == 'auto':
        return
    host, _, port = address.removeprefix('ray://').rpartition(':')
    if not host or not port.isdigit():
        raise ConfigError(
            f"--ray '{address}': not an address; allowed: local, auto, HOST:PORT, ray://HOST:PORT"
        )
    try:
        socket.create_connection((host.strip('[]'), int(port)), timeout=_ANSWER_S).close()
    except (OSError, OverflowError) as error:
        raise ConfigError(f"--ray '{address}': no Ray answers there ({error})") from None


def _first(ray: Any, under_way: set[Any]) -> Iterable[list[Row]]:
    """Yield the portion that is ready first."""
    (ready,), _ = ray.wait(list(under_way), num_returns=1)
    under_way.remove(ready)
    yield ray.get(ready)
