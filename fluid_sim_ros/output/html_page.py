# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A page with its data inside: one HTML file that needs nothing beside it.

``html_page.css`` and ``html_page.js`` are what all pages share; their text becomes part of each.
"""

import html
import json
import re
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import printable
from fluid_sim_ros.output.new_file import new_file

_PLACE = re.compile(r'/\* STYLE \*/|/\* SCRIPT \*/|TITLE|DATA')
_LONGEST_TITLE = 300
_STYLE = Path(__file__).with_suffix('.css')
_SCRIPT = Path(__file__).with_suffix('.js')


def write_page(template: Path, title: str, content: Any, path: Path) -> Path:
    """
    Write a template with STYLE, SCRIPT, TITLE and DATA (JSON) filled in; return the file.

    Parameters
    ----------
    template
        HTML file with the words STYLE, SCRIPT, TITLE and DATA.
    title
        Of the page, plain text.
    content
        What becomes JSON; no NaN.
    path
        Where the page is written.

    Returns
    -------
    Path
        The file, as given.

    Raises
    ------
    ConfigError
        If it cannot be written; see ``new_file``.

    """
    # no text of the data may end the script element
    data = json.dumps(content, allow_nan=False).replace('<', '\\u003c')
    parts = {
        '/* STYLE */': _STYLE.read_text(encoding='utf-8').strip(),
        '/* SCRIPT */': _SCRIPT.read_text(encoding='utf-8').strip(),
        'TITLE': html.escape(printable(title, _LONGEST_TITLE)),
        'DATA': data,
    }
    # all at once: a word in one of the parts is no place for another
    text = _PLACE.sub(lambda match: parts[match[0]], template.read_text(encoding='utf-8'))
    with new_file(path) as file:
        file.write_text(text, encoding='utf-8')
    return path
