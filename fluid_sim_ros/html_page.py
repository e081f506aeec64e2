"""A page with its data inside: one HTML file that needs nothing beside it."""

import html
import json
from pathlib import Path
from typing import Any


def write_page(template: Path, title: str, content: Any, path: Path) -> Path:
    """Write a template with TITLE and DATA (JSON) filled in; return the file."""
    # no text of the data may end the script element
    data = json.dumps(content, allow_nan=False).replace('<', '\\u003c')
    text = template.read_text(encoding='utf-8')
    text = text.replace('TITLE', html.escape(title)).replace('DATA', data)
    path.write_text(text, encoding='utf-8')
    return path
