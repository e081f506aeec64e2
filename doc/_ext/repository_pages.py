# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Make the pages of doc/ a site, though they are written to be read in the repository.

Links to files of the repository that are no page of the site become the file's path, in words.
Pages of `project/` are those that stand at the top of the repository. The contents of the site
are written below the first page, from `site_contents` in conf.py.
"""

import os
import re
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

DOC = Path(__file__).resolve().parents[1]
ROOT = DOC.parent
LINK = re.compile(r'(!?)\[([^\]]*)\]\(<?([^)\s>]+)>?\)')
HTML_PICTURE = re.compile(r'(<img [^>]*src=")([^":]+)"')
CODE = re.compile(r'^ *```.*?^ *```|`[^`\n]*`', re.DOTALL | re.MULTILINE)
#: Pages of the site that stand at the top of the repository.
TOP = {
    'project/readme': 'README.md',
    'project/changes': 'CHANGELOG.rst',
    'project/benchmarks': 'BENCHMARKS.md',
    'project/contributing': 'CONTRIBUTING.md',
    'project/code_of_conduct': 'CODE_OF_CONDUCT.md',
    'project/security': 'SECURITY.md',
    'project/quality': 'QUALITY_DECLARATION.md',
}
HOMES = {source: f'{page}.md' for page, source in TOP.items()}


def with_site_links(text: str, source: PurePosixPath, page: PurePosixPath) -> str:
    """
    Return a page's text with its links as they are on the site.

    Parameters
    ----------
    text
        The text, with links relative to ``source``.
    source
        The file that it is from, relative to the repository.
    page
        The page that it becomes, relative to ``doc``.

    """
    here = f'doc/{page.parent}'

    def rewritten_picture(match: re.Match[str]) -> str:
        target = os.path.normpath(source.parent / match[2])
        return f'{match[1]}{os.path.relpath(target, here)}"'

    def rewritten(match: re.Match[str]) -> str:
        picture, label, link = match.groups()
        name, mark, anchor = link.partition('#')
        if not name or re.match(r'[a-z]+:', link):
            return match[0]
        target = os.path.normpath(source.parent / name)
        if picture:
            return f'![{label}]({os.path.relpath(target, here)})'
        if target in HOMES:
            target = f'doc/{HOMES[target]}'
        if target.startswith('doc/') and target.endswith('.md'):
            shown = '' if label == link else label  # the page's title stands for its file
            return f'[{shown}]({os.path.relpath(target, here)}{mark}{anchor})'
        shown = f'`{target}`'
        return shown if label.strip('`') in (target, name) else f'{label} ({shown})'

    parts, last = [], 0
    for code in CODE.finditer(text):
        # code between the brackets of a link stays a part of the link
        if text[: code.start()].endswith('[') and text[code.end() :].startswith(']('):
            continue
        parts += [LINK.sub(rewritten, text[last : code.start()]), code[0]]
        last = code.end()
    whole = ''.join([*parts, LINK.sub(rewritten, text[last:])])
    return HTML_PICTURE.sub(rewritten_picture, whole)


def markdown_of(changelog: str) -> str:
    """Return CHANGELOG.rst as Markdown: one heading for each version."""
    _, _, versions = changelog.partition('^\n\n')
    headed = re.sub(r'^(\d.*)\n-+$', r'## \1\n', versions, flags=re.MULTILINE)
    return '# Changes\n\n' + headed.replace('``', '`')


def contents(pages: dict[str, list[str]]) -> str:
    """Return the tables of contents of the whole site, which are shown at the side only."""
    trees = []
    for caption, names in pages.items():
        head = [':hidden:', f':caption: {caption}', ':glob:', '']
        trees.append('\n'.join(['```{toctree}', *head, *names, '```']))
    return '\n\n' + '\n\n'.join(trees)


def read_source(app: Sphinx, name: str, source: list[str]) -> None:
    """Change the text of a page before it is parsed."""
    page = PurePosixPath(f'{name}.md')
    origin = PurePosixPath(TOP.get(name, f'doc/{page}'))
    there = name in TOP and (ROOT / origin).exists()  # not where rosdoc2 has copied doc/ alone
    text = (ROOT / origin).read_text(encoding='utf-8') if there else source[0]
    if there and origin.suffix == '.rst':
        text = markdown_of(text)
    text = with_site_links(text, origin if there else PurePosixPath(f'doc/{page}'), page)
    if name == 'index':
        text += contents(app.config.site_contents)
    if name == 'vehicles/README':
        text += '\n\n```{toctree}\n:hidden:\n:glob:\n\n[!R]*\n```\n'
    source[0] = text


def complete_contents(app: Sphinx) -> None:
    """Refuse contents that name a page which is not there; add pages that they do not name."""
    pages = {str(path.relative_to(DOC).with_suffix('')) for path in DOC.rglob('*.md')}
    named = [name for names in app.config.site_contents.values() for name in names]
    missing = [name for name in named if not any(fnmatch(page, name) for page in pages)]
    if missing:
        raise ExtensionError(f'site_contents in doc/conf.py names no page: {", ".join(missing)}')
    below = {page for page in pages if page.startswith('vehicles/')}
    more = {page for page in pages - below if not any(fnmatch(page, name) for name in named)}
    if rest := sorted(more - {'index'}):
        app.config.site_contents = {**app.config.site_contents, 'More': rest}


def setup(app: Sphinx) -> dict[str, bool]:
    """Register what changes the pages."""
    app.add_config_value('site_contents', {}, 'env')
    app.connect('builder-inited', complete_contents)
    app.connect('source-read', read_source)
    return {'parallel_read_safe': True}
