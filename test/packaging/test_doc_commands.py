# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands and programs of README.md and doc/ run, with no more than ``make demo`` installs."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from importlib import metadata

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from test.support.doc_blocks import blocks, files_of, tutorials
from test.support.doc_commands import EXCERPTS, NOT_RUN, SHORTER, plain, run_block
from test.support.egg_info import sections
from test.support.paths import ROOT

_BLOCKER = """
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.partition('.')[0] in {blocked}:
            raise ModuleNotFoundError(f'No module named {{name!r}}', name=name)
sys.meta_path.insert(0, Blocker())
"""
#: Run by `make test-full`, and by .ci/run in a step of their own.
SHELL = [
    pytest.param(block, id=f'{block.page}:{block.line}', marks=pytest.mark.full)
    for block in tutorials(blocks(shell=True))
]
#: Those that are not saved as a file, which commands of the page then run.
PYTHON = [
    pytest.param(block, id=f'{block.page}:{block.line}')
    for block in blocks(shell=False)
    if block.text not in files_of(block.page).values()
]


def demo_distributions():
    """Return the names of the distributions that ``make demo`` installs, as far as here."""
    text = (ROOT / '.ci' / 'venv').read_text()
    extras = set(re.search(r"groups='demo'; extras='([^']*)'", text)[1].split(','))
    found, todo = set(), [('fluid_sim_ros', extras)]
    while todo:
        name, wanted = todo.pop()
        try:
            lines = metadata.requires(name) or []
        except metadata.PackageNotFoundError:
            continue  # of another Python or system
        found.add(canonicalize_name(name))
        for requirement in map(Requirement, lines):
            marker = requirement.marker
            asked = (
                any(marker.evaluate({'extra': extra}) for extra in wanted or {''})
                if marker
                else True
            )
            if asked and (canonicalize_name(requirement.name) not in found or requirement.extras):
                todo.append((requirement.name, requirement.extras))
    return found


def not_in_the_demo():
    """Return the modules that the tests have and ``make demo`` does not install."""
    there, keep = demo_distributions(), {'pip', 'setuptools', 'wheel'}
    return sorted(
        module
        for module, owners in metadata.packages_distributions().items()
        if module.isidentifier()
        and not {canonicalize_name(owner) for owner in owners} & (there | keep)
    )


@pytest.fixture
def checkout(tmp_path, egg_info):
    """Return a folder as a checkout after ``make demo``, and the environment to use in it."""
    programs = tmp_path / '.venv' / 'bin'
    programs.mkdir(parents=True)
    scripts = sections((egg_info / 'entry_points.txt').read_text())['console_scripts']
    for line in scripts:
        name, value = (part.strip() for part in line.split('='))
        module, function = value.split(':')
        code = f'import sys; sys.argv[0] = {name!r}; from {module} import {function} as run; '
        call = shlex.join([sys.executable, '-c', f'{code}sys.exit(run())'])
        (programs / name).write_text(f'#!/bin/sh\nexec {call} "$@"\n')
        (programs / name).chmod(0o755)
    (programs / 'python').write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
    (programs / 'python').chmod(0o755)
    for folder in ('config', 'models'):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    blocker = tmp_path / 'blocker'
    blocker.mkdir()
    (blocker / 'sitecustomize.py').write_text(_BLOCKER.format(blocked=set(not_in_the_demo())))
    environment = dict(
        os.environ, PYTHONPATH=f'{blocker}:{ROOT}', PATH=f'{programs}:{os.environ["PATH"]}',
        COLUMNS='80',
    )  # fmt: skip
    return tmp_path, environment


@pytest.mark.ros
@pytest.mark.timeout(900)
@pytest.mark.parametrize('block', SHELL)
def test_each_command_block_runs_right_after_make_demo(block, checkout):
    run_block(block, *checkout)


@pytest.mark.parametrize('block', PYTHON)
def test_each_python_block_runs(block, checkout):
    if block.page in EXCERPTS or block.page == 'README.md':  # that runs below
        return
    folder, environment = checkout
    done = subprocess.run(
        [sys.executable, '-c', block.text], cwd=folder, env=environment, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def test_the_python_example_of_the_readme_prints_no_zeros(checkout):
    folder, environment = checkout
    (text,) = [block.text for block in blocks(shell=False) if block.page == 'README.md']
    done = subprocess.run(
        [sys.executable, '-c', text], cwd=folder, env=environment, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    numbers = [float(word) for word in re.findall(r'-?\d+\.?\d*(?:e[+-]\d+)?', done.stdout)]
    assert len(numbers) >= 6
    assert sum(abs(number) > 1e-6 for number in numbers) >= 3


def test_what_is_not_run_is_still_shown_and_says_why():
    shown = [plain(command) for block in blocks(shell=True) for command in block.commands]
    for start, why in [*NOT_RUN.items(), *((start, 'short') for start in SHORTER)]:
        assert any(command.startswith(start) for command in shown), start
        assert start in SHORTER or why
    pages = {block.page for block in blocks(shell=False)}
    assert set(EXCERPTS) <= pages


def test_what_the_tests_have_besides_is_known():
    blocked = not_in_the_demo()
    assert {'pytest', 'hypothesis'} <= set(blocked)
    assert not {'numpy', 'mujoco', 'rclpy', 'matplotlib', 'mcap', 'pymavlink'} & set(blocked)


def test_each_file_of_a_tutorial_is_used_by_a_command_of_its_page():
    pages = {block.page: block.text for block in tutorials(blocks(shell=True))}
    files = [
        (page, name) for page in pages if page.startswith('doc/tutorials/')
        for name in files_of(page)
    ]  # fmt: skip
    assert len(files) >= 4
    assert [(page, name) for page, name in files if name not in pages[page]] == []
