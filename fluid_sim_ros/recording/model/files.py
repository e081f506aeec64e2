# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The files that a model names, gathered: what a log holds, and all that its scene is compiled from.

``gather`` follows every attribute that names a file (includes, meshes, height fields, textures,
skins, flexes, attached models, URDF meshes), asks for each file, and returns the model as text
whose references are names of assets: ``<hash of the content>/<file name>``. MuJoCo finds those in
its virtual file system and has no cause to look at the disk.
"""

import hashlib
import posixpath
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from fluid_sim_ros.errors import printable
from fluid_sim_ros.recording.model.mjcf_text import Element, MjcfError, mjcf_text, parse_mjcf

#: Returns the content of the file at a path, or nothing where there is none.
Read = Callable[[str], bytes | None]

#: Element -> the compiler's attribute with the folder of its files.
_ASSETS = {
    'mesh': 'meshdir', 'hfield': 'meshdir', 'skin': 'meshdir', 'flexcomp': 'meshdir',
    'texture': 'texturedir',
}  # fmt: skip
_SIDES = ('fileright', 'fileleft', 'fileup', 'filedown', 'filefront', 'fileback')
_FOLDERS = ('meshdir', 'texturedir', 'assetdir', 'strippath')
#: Attributes that name files, so far as MuJoCo's schema and URDF have them.
_NAMES_A_FILE = re.compile(r'file', re.IGNORECASE)
#: What may mean more to MuJoCo than a part of a name: arguments, providers, other separators.
_UNUSUAL = re.compile(r'[^\w .,+()@~-]')
#: Models attached within models.
_DEEPEST = 8


@dataclass
class Gathered:
    """
    A model and its files.

    Attributes
    ----------
    text
        The model; its references are names of ``assets``.
    assets
        Name -> content; attached models are among them.
    used
        Path, as it was asked for -> content of every file, the model and its includes too.
    attached
        Path of an attached model -> its name in ``assets``.

    """

    text: str = ''
    assets: dict[str, bytes] = field(default_factory=dict)
    used: dict[str, bytes] = field(default_factory=dict)
    attached: dict[str, str] = field(default_factory=dict)


def gather(path: str, read: Read, text: bytes | None = None) -> Gathered:
    """
    Follow a model's references.

    Parameters
    ----------
    path
        Of the model, with ``/``; its references are relative to its folder.
    read
        Returns the content of the file at a path (lexically normal), or None.
    text
        Of the model, in place of the file.

    Returns
    -------
    Gathered
        The model and its files.

    Raises
    ------
    MjcfError
        For a file that is not there, no XML, or a name that is none.

    """
    found = Gathered()
    content = read(path) if text is None else text
    if content is None:
        raise MjcfError(f"the file '{printable(path)}' is not there")
    if text is None:
        found.used[path] = content
    found.text = _Model(path, read, found, ()).rewritten(content)
    return found


class _Model:
    """One MJCF or URDF file with its includes; models that it attaches have their own."""

    def __init__(self, path: str, read: Read, found: Gathered, within: tuple[str, ...]) -> None:
        if path in within:
            raise MjcfError(f"model '{printable(path)}' attaches itself")
        if len(within) >= _DEEPEST:
            raise MjcfError(f'models are attached more than {_DEEPEST} deep in one another')
        self._path, self._folder = path, posixpath.dirname(path)
        self._read, self._found, self._within = read, found, (*within, path)
        self._included = {path}
        self._compiler: dict[str, str] = {}
        self._places: dict[Element, str] = {}  # folder of the included file that holds an element

    def rewritten(self, content: bytes) -> str:
        """Return the model's text with its includes in place and its files as assets."""
        root = self._parsed(self._path, content)
        self._expand(root, self._folder)
        if root.tag == 'robot':
            self._keep_folders_of_urdf(root)
        for element in root.iter():
            self._rewrite(element)
        return mjcf_text(root)

    def _parsed(self, path: str, content: bytes) -> Element:
        try:
            return parse_mjcf(content)
        except MjcfError as error:
            raise MjcfError(f'{printable(path)}: {error}') from None

    # ---- includes --------------------------------------------------------------------------

    def _expand(self, parent: Element, folder: str) -> None:
        """Put the children of included files in the place of the includes."""
        children: list[Element] = []
        for child in parent:
            tag = child.tag.lower()
            if tag == 'compiler':
                self._take_folders(child)
            if tag != 'include':
                self._expand(child, folder)
                self._places[child] = folder
                children.append(child)
                continue
            path, content = self._included_file(child, folder)
            root = self._parsed(path, content)
            self._expand(root, posixpath.dirname(path))
            children += root
        parent[:] = children

    def _take_folders(self, compiler: Element) -> None:
        """Take the compiler's folders over; later ones win, and the special one over assetdir."""
        stated = {key: compiler.attrib.pop(key, None) for key in _FOLDERS}
        if stated['assetdir'] is not None:
            self._compiler |= dict.fromkeys(('meshdir', 'texturedir'), stated['assetdir'])
        for key in ('meshdir', 'texturedir', 'strippath'):
            if (value := stated[key]) is not None:
                self._compiler[key] = value

    def _included_file(self, element: Element, folder: str) -> tuple[str, bytes]:
        name = element.get('file', '')
        if not name:
            raise MjcfError('<include> names no file')
        path, content = self._find(name, [self._folder, folder], element)
        if path in self._included:
            raise MjcfError(f"'{printable(name)}' is included twice")
        self._included.add(path)
        return path, content

    # ---- assets ----------------------------------------------------------------------------

    def _rewrite(self, element: Element) -> None:
        tag = element.tag.lower()
        for key, name in list(element.attrib.items()):
            if not _NAMES_A_FILE.match(key) or not name:
                continue
            if tag == 'model' and key == 'file':
                element.set(key, self._attached(element, name))
            elif self._is_asset(tag, key):
                path, content = self._find(name, self._folders(element, tag, name), element)
                if key == 'file' and tag != 'flexcomp' and not element.get('name'):
                    element.set('name', posixpath.splitext(posixpath.basename(path))[0])
                element.set(key, self._asset(path, content))
            else:
                raise MjcfError(f'<{printable(tag, 40)} {printable(key, 40)}=...> names a file')

    @staticmethod
    def _is_asset(tag: str, key: str) -> bool:
        if key == 'filename':
            return tag in ('mesh', 'texture')  # of URDF
        return (key == 'file' and tag in _ASSETS) or (key in _SIDES and tag == 'texture')

    def _folders(self, element: Element, tag: str, name: str) -> list[str]:
        """Return the folders in which MuJoCo looks for a file of an element, in its order."""
        stated = self._compiler.get(_ASSETS[tag], '')
        folders = [posixpath.join(self._folder, stated.replace('\\', '/'))]
        place = self._places.get(element, self._folder)
        if place == self._folder:
            return folders
        if tag != 'flexcomp':
            return [*folders, place]
        # MuJoCo decides by whether the file lies beside the model, without the meshdir
        beside = self._content(posixpath.normpath(posixpath.join(self._folder, name)))
        return folders if beside is not None else [place]

    def _find(self, name: str, folders: Sequence[str], element: Element) -> tuple[str, bytes]:
        """Return the first file that there is, by its path, and its content."""
        name = name.replace('\\', '/')
        if self._compiler.get('strippath', '').lower() == 'true' and element.tag != 'include':
            name = posixpath.basename(name)
        paths = list(dict.fromkeys(posixpath.normpath(posixpath.join(f, name)) for f in folders))
        for path in paths:
            if (content := self._content(path)) is not None:
                return path, content
        raise MjcfError(f"the file '{printable(name)}' of <{element.tag}> is not there")

    def _content(self, path: str) -> bytes | None:
        used = self._found.used
        if path not in used and (content := self._read(path)) is not None:
            used[path] = content
        return used.get(path)

    def _asset(self, path: str, content: bytes) -> str:
        name = _UNUSUAL.sub('_', posixpath.basename(path))
        key = f'{hashlib.sha256(content).hexdigest()[:32]}/{name}'
        self._found.assets[key] = content
        return key

    def _attached(self, element: Element, name: str) -> str:
        folders = [self._folder, self._places.get(element, self._folder)]
        path, content = self._find(name, folders, element)
        kind = element.attrib.pop('content_type', 'text/xml')
        if 'xml' not in kind and 'mjcf' not in kind:
            raise MjcfError(f"<model content_type='{printable(kind)}'>; only XML can be attached")
        attached = self._found.attached
        if path not in attached:
            text = _Model(path, self._read, self._found, self._within).rewritten(content)
            stem = posixpath.splitext(posixpath.basename(path))[0]
            attached[path] = self._asset(f'{stem}.xml', text.encode())
        return attached[path]

    def _keep_folders_of_urdf(self, root: Element) -> None:
        """Say that file names hold folders, where the URDF had them taken away."""
        for element in root.iter('compiler'):
            element.set('strippath', 'false')
