# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
from test.support.paths import ROOT

PACKAGE = ROOT / 'fluid_sim_ros'
LONGEST = 300
#: Modules that a folder of the package may hold; these hold many small ones of one kind.
MODULES, MORE_MODULES = 18, {'physics': 22, 'lab': 22}
SUFFIXES = ('.py', '.cc', '.h')


def sources(folder):
    return [path for path in sorted(folder.rglob('*')) if path.suffix in SUFFIXES]


def lines_of(path):
    text = path.read_text(encoding='utf-8')
    return text.count('\n') - text[:400].count('SPDX-')  # the head of license lines is no content


def test_files_are_short_enough_to_read():
    folders = [PACKAGE, ROOT / 'test', ROOT / 'benchmarks']
    paths = [path for folder in folders for path in sources(folder)]
    assert len(paths) > 500
    lengths = {str(path.relative_to(ROOT)): lines_of(path) for path in paths}
    too_long = {name: lines for name, lines in lengths.items() if lines > LONGEST}
    assert too_long == {}


def test_folders_hold_few_enough_modules_to_look_through():
    folders = [PACKAGE, *(path for path in PACKAGE.rglob('*') if path.is_dir())]
    crowded = {}
    for folder in folders:
        count = sum(path.suffix in ('.py', '.cc') for path in folder.iterdir())
        if count - (folder / '__init__.py').exists() > MORE_MODULES.get(folder.name, MODULES):
            crowded[str(folder.relative_to(PACKAGE))] = count
    assert crowded == {}
