# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The files of the project, without what was built."""

import subprocess

from test.support.paths import ROOT

_IGNORED = ('.git', '.venv', 'build', 'install', 'log', 'out')


def project_files():
    """Return the files that git tracks; outside a git checkout, all but what was built."""
    listing = subprocess.run(
        ['git', 'ls-files', '-z'], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listing.returncode == 0 and listing.stdout:
        paths = [ROOT / name for name in listing.stdout.split('\0') if name]
        return [path for path in paths if path.is_file()]
    return [
        path for path in ROOT.rglob('*')
        if path.is_file() and path.relative_to(ROOT).parts[0] not in _IGNORED
    ]  # fmt: skip
