"""
A page with its data inside: one HTML file that needs nothing beside it.

``html_page.css`` and ``html_page.js`` are what all pages share; their text becomes part of each.
"""

import html
import json
from pathlib import Path
from typing import Any

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

    """
    # no text of the data may end the script element
    data = json.dumps(content, allow_nan=False).replace('<', '\\u003c')
    text = template.read_text(encoding='utf-8')
    for place, file in (('/* STYLE */', _STYLE), ('/* SCRIPT */', _SCRIPT)):
        text = text.replace(place, file.read_text(encoding='utf-8').strip())
    text = text.replace('TITLE', html.escape(title)).replace('DATA', data)
    path.write_text(text, encoding='utf-8')
    return path
