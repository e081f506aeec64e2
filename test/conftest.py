# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Shared by all tests: nothing leaves this host, and no two ROS tests share a DDS domain."""

import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path

import pytest
from hypothesis import settings

#: Domains that tests use; the demo picks from 61 to 100, so that neither hears the other.
DOMAINS = range(1, 61)
#: Files whose tests take the longest, most of it waiting.
LONG = (
    'mavlink/px4/test_closed_loops.py', 'ros/test_node.py', 'recording/test_render.py',
    'mavlink/test_autopilot_node.py', 'new_vehicle/test_import.py', 'ros/test_controllers.py',
    'mavlink/ardupilot/test_closed_loops.py', 'ros/test_lockstep.py', 'lab/test_advise.py',
    'ros/test_node_recording.py', 'recording/test_resimulate.py', 'reality/test_fit.py',
)  # fmt: skip
_LOCKS = Path(tempfile.gettempdir()) / f'fluid_sim_ros_test_domains_{os.getuid()}'
_turn = count()
# MuJoCo chooses its renderer when it is imported; tests have no display
os.environ.setdefault('MUJOCO_GL', 'egl')

# the same examples in every run, at whatever pace; no files beside the tests
settings.register_profile('fixed', derandomize=True, deadline=None, database=None)
settings.load_profile('fixed')


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the longest files: at the end one process alone would be at work on each."""
    items.sort(key=lambda item: not item.path.as_posix().endswith(LONG))


@contextmanager
def _own_domain() -> Iterator[int]:
    """
    Hold a domain that no other test process on this host holds.

    Start points differ per process and per turn, so that a domain rests before it is used again;
    a lock file keeps two runs of the tests apart.
    """
    _LOCKS.mkdir(exist_ok=True)
    worker = int(os.environ.get('PYTEST_XDIST_WORKER', 'gw0')[2:])
    start = os.getpid() + 37 * worker + next(_turn)
    for i in range(len(DOMAINS)):
        domain = DOMAINS[(start + i) % len(DOMAINS)]
        with (_LOCKS / str(domain)).open('w') as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield domain
            return
    raise RuntimeError(f'every ROS domain from 1 to {DOMAINS[-1]} is in use by other tests')


@contextmanager
def _environment(**values: str) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        for name, value in values.items():
            patch.setenv(name, value)
        yield


@pytest.fixture(scope='session', autouse=True)
def _stay_on_this_host(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep discovery and logs of every test, and of the processes it starts, to themselves."""
    logs = tmp_path_factory.mktemp('ros_log')
    # imported here, since MuJoCo would be before its renderer is chosen
    from fluid_sim_ros.ros.process.this_host import FAST_DDS_PROFILES, PROFILE

    profiles = dict.fromkeys(FAST_DDS_PROFILES, str(PROFILE))
    values = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_LOG_DIR': str(logs)}
    with _environment(**profiles, **values):
        yield


@pytest.fixture
def ros_domain() -> Iterator[int]:
    """Give the test, and the processes it starts, a ROS_DOMAIN_ID of their own."""
    with _own_domain() as domain, _environment(ROS_DOMAIN_ID=str(domain)):
        yield domain


@pytest.fixture(autouse=True)
def _ros_tests_have_a_domain(request: pytest.FixtureRequest) -> None:
    """Give every test marked ``ros`` a domain of its own: none is left in the common one."""
    marked = request.node.get_closest_marker('ros') is not None
    if marked and 'ros_domain_of_module' not in request.fixturenames:
        request.getfixturevalue('ros_domain')


@pytest.fixture(scope='module')
def ros_domain_of_module() -> Iterator[int]:
    """As ``ros_domain``, for fixtures that serve all tests of a file."""
    with _own_domain() as domain, _environment(ROS_DOMAIN_ID=str(domain)):
        yield domain
