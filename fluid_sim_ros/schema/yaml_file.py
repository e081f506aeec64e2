# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Reads YAML files of others: plain values only, within limits, and one error for whatever is wrong.

The parser of libyaml gives events; values are built from them at once. PyYAML's own way, a graph
of nodes first, costs ten times the memory, goes as deep as the brackets, and lets aliases of
aliases stand for more values than any memory holds.
"""

from pathlib import Path
from typing import Any

import yaml

from fluid_sim_ros.errors import ConfigError, LimitError, printable
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import beyond, check_limit, limit

#: libyaml's parser where PyYAML has it, else the one in Python.
_Events: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)
#: What a mapping that is merged into another is named by.
_MERGE = 'tag:yaml.org,2002:merge'


def read_yaml(path: Path) -> Any:
    """
    Return the content of a YAML file.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    object
        Mappings, lists, texts, numbers, booleans, dates, bytes and None.

    Raises
    ------
    ConfigError
        With the file, the line and what is wrong; a ``LimitError`` of ``yaml_bytes``,
        ``yaml_depth`` or ``yaml_values`` says how to raise it.

    """
    try:
        with open_data(path) as file:
            text = file.read(limit('yaml_bytes') + 1)
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except OSError as error:
        raise ConfigError(f'{path}: {error.strerror or error}') from None
    return parse_yaml(text, str(path))


def parse_yaml(text: bytes, where: str) -> Any:
    """
    Return the content of YAML text.

    Parameters
    ----------
    text
        UTF-8.
    where
        What errors begin with.

    Returns
    -------
    object
        As ``read_yaml``.

    Raises
    ------
    ConfigError
        As ``read_yaml``.

    """
    try:
        check_limit('yaml_bytes', len(text), 'size')
        return _Values(text.decode('utf-8')).document()
    except LimitError as error:
        raise LimitError(f'{where}: {error}') from None
    except UnicodeDecodeError as error:
        raise ConfigError(f'{where}: not UTF-8: byte {error.start}') from None
    except yaml.YAMLError as error:
        raise ConfigError(f'{where}: not valid YAML: {printable(_one_line(error), 500)}') from None


def _one_line(error: object) -> str:
    return ' '.join(str(error).replace('"<unicode string>", ', '').split())


class _Values(yaml.constructor.SafeConstructor, yaml.resolver.Resolver):
    """Builds values from the events of a parser."""

    def __init__(self, text: str) -> None:
        yaml.constructor.SafeConstructor.__init__(self)
        yaml.resolver.Resolver.__init__(self)
        self._parser = _Events(text)
        self._anchors: dict[str, tuple[Any, int]] = {}
        self._scalars: dict[tuple[str, str | None, bool], Any] = {}
        self._most = limit('yaml_values')
        self._deepest = limit('yaml_depth')
        self._depth = 0

    def document(self) -> Any:
        """Return the value of the only document; None where there is none."""
        event = self._parser.get_event()
        while not isinstance(event, yaml.DocumentStartEvent):
            if isinstance(event, yaml.StreamEndEvent):
                return None
            event = self._parser.get_event()
        value, _ = self._value(self._parser.get_event())
        self._parser.get_event()  # the document's end
        event = self._parser.get_event()
        if not isinstance(event, yaml.StreamEndEvent):
            raise _fault('one document only', event)
        return value

    def _value(self, event: Any) -> tuple[Any, int]:
        """Return the value that begins with an event, and how many values it holds."""
        kind = type(event)
        if kind is yaml.AliasEvent:
            if event.anchor not in self._anchors:
                raise _fault(f'alias {printable(event.anchor)} has no anchor before it', event)
            found = self._anchors[event.anchor]
            if found[1] < 0:
                raise _fault(f'alias {printable(event.anchor)} is part of itself', event)
            return found
        if kind is yaml.ScalarEvent:
            found = self._scalar(event), 1
        else:
            if event.anchor:
                self._anchors[event.anchor] = None, -1
            found = self._collection(event)
        if event.anchor:
            self._anchors[event.anchor] = found
        return found

    def _collection(self, event: Any) -> tuple[Any, int]:
        self._depth += 1
        if self._depth > self._deepest:
            raise beyond('yaml_depth', self._deepest, f'line {_line(event)}: a level more')
        sequence = isinstance(event, yaml.SequenceStartEvent)
        names = ('!', None, f'tag:yaml.org,2002:{"seq" if sequence else "map"}')
        if event.tag not in names:
            raise _fault(f'the tag {printable(event.tag)} is not allowed', event)
        found = self._sequence() if sequence else self._mapping()
        self._depth -= 1
        return found

    def _counted(self, count: int, event: Any) -> None:
        if count > self._most:
            raise beyond('yaml_values', self._most, f'line {_line(event)}: a value more')

    def _sequence(self) -> tuple[list[Any], int]:
        values, count = [], 1
        while type(event := self._parser.get_event()) is not yaml.SequenceEndEvent:
            value, size = self._value(event)
            count += size
            self._counted(count, event)
            values.append(value)
        return values, count

    def _mapping(self) -> tuple[dict[Any, Any], int]:
        values: dict[Any, Any] = {}
        merged: dict[Any, Any] = {}
        count = 1
        while type(event := self._parser.get_event()) is not yaml.MappingEndEvent:
            merge = type(event) is yaml.ScalarEvent and event.value == '<<' and self._merges(event)
            key, keys = ('<<', 1) if merge else self._value(event)
            value, size = self._value(self._parser.get_event())
            count += keys + size
            self._counted(count, event)
            if merge:
                merged = _merged(value, event) | merged
                continue
            if isinstance(key, list | dict | set):
                raise _fault('a key must be a text or a number', event)
            if key in values:
                raise _fault(f'key {printable(key)!r} stands twice', event)
            values[key] = value
        return (merged | values if merged else values), count

    def _merges(self, event: Any) -> bool:
        return self._tag(event) == _MERGE

    def _tag(self, event: Any) -> str:
        if event.tag not in (None, '!'):
            return str(event.tag)
        resolve: Any = self.resolve
        return str(resolve(yaml.ScalarNode, event.value, event.implicit))

    def _scalar(self, event: Any) -> Any:
        key = (event.value, event.tag, event.implicit[0])
        if key in self._scalars:
            return self._scalars[key]
        tag = self._tag(event)
        make = self.yaml_constructors.get(tag)
        if make is None:
            raise _fault(f'the tag {printable(tag)} is not allowed', event)
        try:
            value = make(self, yaml.ScalarNode(tag, event.value))
        except (ValueError, OverflowError, LookupError, AttributeError, TypeError) as error:
            text = printable(event.value, 60)
            raise _fault(f'{text!r} is no value: {printable(error_text(error))}', event) from None
        self._scalars[key] = value
        return value


def error_text(error: BaseException) -> str:
    """
    Return what an error says, on one line.

    Parameters
    ----------
    error
        Of a library.

    """
    return printable(' '.join(str(error).split()) or type(error).__name__, 500)


def _merged(value: Any, event: Any) -> dict[Any, Any]:
    """Return what ``<<`` brings into a mapping: that of one, or of a list, the first leading."""
    found: dict[Any, Any] = {}
    for part in value if isinstance(value, list) else [value]:
        if not isinstance(part, dict):
            raise _fault('<< needs a mapping, or a list of mappings', event)
        found = part | found
    return found


def _line(event: Any) -> int:
    return int(event.start_mark.line) + 1


def _fault(message: str, event: Any) -> yaml.YAMLError:
    return yaml.YAMLError(f'{message} (line {_line(event)})')
