"""Each source file says whose it is and under which license, in the form of REUSE (spdx.org)."""

import subprocess

import pytest

from test.support.paths import ROOT

SUFFIXES = ('.py', '.cc', '.h', '.mjs', '.js', '.css')
HEAD = (
    'SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers',
    'SPDX-License-Identifier: Apache-2.0',
)


@pytest.mark.skipif(
    not (ROOT / '.git').exists(), reason='needs a checkout: asks git for the files'
)
def test_each_source_file_has_its_copyright_and_license():
    listed = subprocess.run(
        ['git', 'ls-files'], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    sources = [ROOT / name for name in listed if name.endswith(SUFFIXES)]
    texts = {p: p.read_text(encoding='utf-8') for p in sources if p.is_file()}
    assert len(texts) > 1000
    lacking = [
        p for p, text in texts.items() if text.strip() and not all(h in text[:400] for h in HEAD)
    ]
    assert lacking == []
