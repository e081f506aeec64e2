# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Each source file says whose it is and under which license, in the form of REUSE (spdx.org)."""

from test.support.project_files import project_files

SUFFIXES = ('.py', '.cc', '.h', '.mjs', '.js', '.css')
HEAD = (
    'SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers',
    'SPDX-License-Identifier: Apache-2.0',
)


def test_each_source_file_has_its_copyright_and_license():
    sources = [path for path in project_files() if path.suffix in SUFFIXES]
    texts = {path: path.read_text(encoding='utf-8') for path in sources}
    assert len(texts) > 1000
    lacking = [path for path, text in texts.items() if text.strip() and not has_head(text)]
    assert lacking == []


def has_head(text):
    """Whether both lines stand at the begin, behind a line for the shell at most."""
    lines = '\n'.join(text.splitlines()[:3])
    return all(line in lines for line in HEAD)
