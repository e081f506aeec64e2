"""Build the documentation site from doc/ into out/site; a warning is a fault."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SITE = ROOT / 'out' / 'site'


def build() -> int:
    """Run Sphinx; return its exit code."""
    options = ['-W', '--keep-going', '-q', '-j', 'auto', '-b', 'html']
    command = [sys.executable, '-m', 'sphinx', *options, str(ROOT / 'doc'), str(SITE)]
    return subprocess.run(command, check=False).returncode


def main() -> int:
    """Build the site and say where it is."""
    if code := build():
        return code
    print(f'site: {SITE.relative_to(ROOT)}/index.html')
    return 0


if __name__ == '__main__':
    sys.exit(main())
