# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Build the documentation site from doc/ into out/site, and ask its search ten questions.

A warning of Sphinx is a fault, and so is a question whose first hit is another page.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SITE = ROOT / 'out' / 'site'
#: What a stranger would type, and where the first hit must lead.
QUESTIONS = {
    'where do I set the water density?': 'faq#where-do-i-set-the-water-density',
    'how do I add a sensor?': 'faq#how-do-i-add-a-sensor',
    'why does my ROV spin?': 'faq#why-does-my-rov-spin',
    'simulation diverges': 'faq',
    'which timestep': 'tutorials/model_and_timestep',
    'import URDF': 'tutorials/own_vehicle',
    'wave height': 'waves',
    'replay log': 'logs',
    'compare real flight': 'reality',
    'Monte Carlo': 'sweep',
}


def questions() -> str:
    """Return the table of the questions and their pages, as it stands in the documentation."""
    rows = [f'| {asked} | [{page}]({_file(page)}) |' for asked, page in QUESTIONS.items()]
    return '\n'.join(['| Question | First hit |', '|---|---|', *rows])


def _file(page: str) -> str:
    name, mark, anchor = page.partition('#')
    return f'{name}.md{mark}{anchor}'


def build() -> int:
    """Run Sphinx; return its exit code."""
    options = ['-W', '--keep-going', '-q', '-j', 'auto', '-b', 'html']
    command = [sys.executable, '-m', 'sphinx', *options, str(ROOT / 'doc'), str(SITE)]
    return subprocess.run(command, check=False).returncode


def first_hits(node: str, asked: list[str]) -> dict[str, str]:
    """
    Return the first hit of each question, by the code of the site's own search.

    Parameters
    ----------
    node
        Command of Node.js, which runs that code.
    asked
        The questions.

    """
    done = subprocess.run(
        [node, str(Path(__file__).with_name('search.mjs')), str(SITE)],
        input=json.dumps(asked), capture_output=True, text=True, check=True,
    )  # fmt: skip
    return {
        question: (hits or ['nothing'])[0] for question, hits in json.loads(done.stdout).items()
    }


def main() -> int:
    """Build the site, ask it, and say where it is."""
    if code := build():
        return code
    node = shutil.which('node')
    if node is None:
        print('site: its search was not asked: Node.js is not installed')
    else:
        found = first_hits(node, list(QUESTIONS))
        wrong = {asked: page for asked, page in found.items() if page != QUESTIONS[asked]}
        for asked, page in wrong.items():
            print(f'site: "{asked}" leads to {page}, not to {QUESTIONS[asked]}')
        if wrong:
            return 1
        print(f'site: each of {len(found)} questions leads to its page')
    print(f'site: {SITE.relative_to(ROOT)}/index.html')
    return 0


if __name__ == '__main__':
    sys.exit(main())
