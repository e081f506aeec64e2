# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Print the notes of one version, from CHANGELOG.rst, as Markdown for a release."""

import re
import sys
from pathlib import Path

CHANGELOG = Path(__file__).resolve().parents[1] / 'CHANGELOG.rst'
HEADING = re.compile(r'^(\d+\.\d+\.\d+) \((\d{4}-\d{2}-\d{2})\)\n-+\n', re.MULTILINE)


def notes(text: str, version: str) -> str:
    """
    Return the section of a version, without its heading.

    Raises
    ------
    ValueError
        If the changelog has no such version; the message lists those it has.

    """
    parts = HEADING.split(text)[1:]
    sections = dict(zip(parts[::3], parts[2::3], strict=True))
    if version not in sections:
        raise ValueError(
            f'CHANGELOG.rst has no version {version!r}; it has: {", ".join(sections)}'
        )
    return sections[version].strip().replace('``', '`') + '\n'


def main() -> int:
    """Print the notes of the version on the command line."""
    if len(sys.argv) != 2:
        print('usage: .ci/release_notes.py 1.2.3', file=sys.stderr)
        return 2
    try:
        print(notes(CHANGELOG.read_text(encoding='utf-8'), sys.argv[1]), end='')
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
