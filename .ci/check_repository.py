# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Check the files that hosts of repositories read, by schemas of check-jsonschema."""

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: Schema, and the files that it is for.
CHECKED = {
    'github-workflows': '.github/workflows/*.yml',
    'github-issue-forms': '.github/ISSUE_TEMPLATE/[!c]*.yml',
    'github-issue-config': '.github/ISSUE_TEMPLATE/config.yml',
    'dependabot': '.github/dependabot.yml',
    'citation-file-format': 'CITATION.cff',
    'readthedocs': '.readthedocs.yaml',
}


def faults(root: Path = ROOT, schemas: Iterable[str] = tuple(CHECKED)) -> list[str]:
    """Return what is wrong, one text for each schema; a schema without a file is a fault, too."""
    found = []
    for schema in schemas:
        pattern = CHECKED[schema]
        files = sorted(root.glob(pattern))
        if not files:
            found.append(f'{pattern}: no such file')
            continue
        done = subprocess.run(
            [sys.executable, '-m', 'check_jsonschema', '--builtin-schema', f'vendor.{schema}',
             *map(str, files)],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode:
            found.append(done.stdout + done.stderr)
    return found


def main() -> int:
    """Print the faults; the exit code says whether there are any."""
    found = faults()
    for text in found or ['repository: workflows, issue forms and citation fit their schemas']:
        print(text)
    return bool(found)


if __name__ == '__main__':
    sys.exit(main())
