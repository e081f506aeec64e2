# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What hosts of repositories and citing programs read is complete, valid, and says one version."""

import json
import re
import shutil

import check_repository
import pytest
import release_notes
import yaml

import fluid_sim_ros
from test.support.paths import ROOT


def test_the_citation_names_this_version():
    citation = yaml.safe_load((ROOT / 'CITATION.cff').read_text())
    changelog = (ROOT / 'CHANGELOG.rst').read_text()
    version = fluid_sim_ros.__version__
    assert citation['version'] == version
    assert f'\n{version} ({citation["date-released"]})\n' in changelog


def test_the_release_notes_of_each_version_are_its_section():
    text = '=\nHead\n=\n\n0.2.0 (2027-01-01)\n---\n* ``b``\n\n0.1.0 (2026-01-01)\n---\n* a\n'
    assert release_notes.notes(text, '0.2.0') == '* `b`\n'
    assert release_notes.notes(text, '0.1.0') == '* a\n'
    with pytest.raises(ValueError, match=r"no version '1\.0'; it has: 0\.2\.0, 0\.1\.0"):
        release_notes.notes(text, '1.0')


def test_this_version_has_release_notes():
    text = (ROOT / 'CHANGELOG.rst').read_text()
    assert release_notes.notes(text, fluid_sim_ros.__version__).startswith('* ')


def test_a_workflow_that_no_host_would_run_is_found(tmp_path):
    pytest.importorskip('check_jsonschema', reason='needs the extra dev')
    shutil.copytree(ROOT / '.github', tmp_path / '.github')
    assert check_repository.faults(tmp_path, ['github-workflows']) == []
    workflow = tmp_path / '.github' / 'workflows' / 'ci.yml'
    workflow.write_text(workflow.read_text().replace('runs-on:', 'run-on:', 1))
    wrong, missing = check_repository.faults(
        tmp_path, ['github-workflows', 'citation-file-format']
    )
    assert 'ci.yml' in wrong
    assert missing == 'CITATION.cff: no such file'


def test_workflows_and_hooks_run_what_is_there():
    texts = [path.read_text() for path in (ROOT / '.github').rglob('*.yml')]
    texts.append((ROOT / '.pre-commit-config.yaml').read_text())
    named = {name for text in texts for name in re.findall(r'\.ci/\w+(?:\.py)?', text)}
    assert named >= {'.ci/run', '.ci/check_wheel.py', '.ci/release_notes.py'}
    assert [name for name in sorted(named) if not (ROOT / name).exists()] == []
    targets = re.findall(r'^([\w-]+):', (ROOT / 'Makefile').read_text(), re.MULTILINE)
    used = {
        name for text in texts for name in re.findall(r'^\s+make ([\w-]+)', text, re.MULTILINE)
    }
    assert used <= set(targets)


def test_the_container_of_the_editor_is_the_one_of_the_image():
    devcontainer = json.loads((ROOT / '.devcontainer' / 'devcontainer.json').read_text())
    images = re.findall(r'^FROM (\S+)', (ROOT / 'Dockerfile').read_text(), re.MULTILINE)
    assert set(images) == {devcontainer['image']}
