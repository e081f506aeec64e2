# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Check that each link and picture of the Markdown pages leads to a file or heading."""

import re
import sys
from pathlib import Path

LINK = re.compile(r'!?\[[^\]]*\]\(\s*<?([^)\s>]+)>?[^)]*\)')
HTML_LINK = re.compile(r'(?:src|href)="([^"]+)"')
CODE = re.compile(r'```.*?```|`[^`\n]*`', re.DOTALL)
HEADING = re.compile(r'^#+\s+(.*?)\s*#*$', re.MULTILINE)


def anchors(page: Path) -> set[str]:
    """Return the anchors that a Markdown page's headings get (GitHub's rule)."""
    text = re.sub(r'```.*?```', '', page.read_text(encoding='utf-8'), flags=re.DOTALL)
    words = (re.sub(r'[^\w\- ]', '', title.lower()) for title in HEADING.findall(text))
    return {title.replace(' ', '-') for title in words}


def broken_links(root: Path) -> list[str]:
    """Return one line for each link that leads nowhere; links to the web are not followed."""
    faults = []
    for page in [*sorted(root.glob('*.md')), *sorted((root / 'doc').rglob('*.md'))]:
        text = CODE.sub('', page.read_text(encoding='utf-8'))
        for link in LINK.findall(text) + HTML_LINK.findall(text):
            if re.match(r'[a-z]+:', link):
                continue
            name, _, anchor = link.partition('#')
            target = (page.parent / name) if name else page
            if not target.exists():
                faults.append(f'{page.relative_to(root)}: {link}: no such file')
            elif anchor and target.suffix == '.md' and anchor not in anchors(target):
                faults.append(f'{page.relative_to(root)}: {link}: no such heading')
    return faults


def main() -> int:
    """Print the faults; the exit code says whether there are any."""
    faults = broken_links(Path(__file__).resolve().parents[1])
    for line in faults or ['docs: every link and picture is there']:
        print(line)
    return bool(faults)


if __name__ == '__main__':
    sys.exit(main())
