# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the program itself says of its commands and files, as tables for doc/reference/."""

import argparse
import inspect
import json
import re
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

import fluid_sim_ros
from fluid_sim_ros.cli.main import _build_parser
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.messages.commands import Commands
from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.ros.parameters import simulator
from fluid_sim_ros.schema.fleet import FleetFile
from fluid_sim_ros.schema.scene import SceneFile
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.sweep.sweep_file import SweepFile

#: Scenes that have, together, every topic and service of the node.
TOPIC_SCENES = ('bluerov2_heavy', 'x500', 'remus100', 'aerosonde', 'x500_slung_load', 'sphere')


def command_line() -> str:
    """Return each command of ``fluid_sim`` with its arguments and options."""
    parser = _build_parser()
    parts = []
    for name, command in parser.commands.items():
        if not command.add_help:
            parts.append(f'## fluid_sim {name}\n\n{_help_of(parser, name)}')
            continue
        parts.append(f'## fluid_sim {name}\n\n{_sentence(command.description or "")}\n')
        parts += ['| Argument | Meaning |', '|---|---|']
        shown = [a for a in command._actions if not isinstance(a, argparse._HelpAction)]
        parts += [_option(action, command) for action in shown]
        if command.epilog:
            parts += ['', _sentence(_cell(command.epilog))]
        parts.append('')
    return '\n'.join(parts).strip()


def _help_of(parser: argparse.ArgumentParser, name: str) -> str:
    """Return what the list of commands says of one that has no help of its own here."""
    (found,) = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    text = next(a.help for a in found._choices_actions if a.dest == name)
    return f'{_sentence(text or "")}\n'


def _option(action: argparse.Action, command: argparse.ArgumentParser) -> str:
    values = _values(action)
    names = ', '.join(f'`{" ".join([name, *values])}`' for name in action.option_strings)
    if not names:
        names = f'`{" ".join(values) or action.dest}`'
    text = command._get_formatter()._expand_help(action) if action.help else ''
    if action.choices and action.metavar is None:
        text = f'{text}; allowed: {", ".join(map(str, action.choices))}'.lstrip('; ')
    return f'| {names} | {_cell(text)} |'


def _values(action: argparse.Action) -> list[str]:
    if action.nargs == 0:
        return []
    name = action.metavar or action.dest.upper()
    several = {'*': '...', '+': '...', '?': ''}.get(str(action.nargs), '')
    names = list(name) if isinstance(name, tuple) else [name]
    return [*names, several] if several else names


def _sentence(text: str) -> str:
    return f'{text[:1].upper()}{text[1:]}'.rstrip('.') + '.'


def _cell(text: str) -> str:
    """Return a text that stands in a cell of a table, and holds no markup by chance."""
    text = ' '.join(text.split()).replace('|', '&#124;').replace('``', '`')
    parts = re.split(r'(`[^`]*`)', text)
    return ''.join(p if p.startswith('`') else re.sub(r'([<>*_])', r'\\\1', p) for p in parts)


def scene_files() -> str:
    """Return the keys of scene files."""
    return _schemas({'Scene file': SceneFile, 'Scene file with several vehicles': FleetFile})


def sweep_files() -> str:
    """Return the keys of sweep files."""
    return _schemas({'Sweep file': SweepFile})


def mapping_files() -> str:
    """Return the keys of the mappings of autopilots."""
    return _schemas({'Mapping of an autopilot': AutopilotFile})


def _schemas(roots: dict[str, type[BaseModel]]) -> str:
    """Return a section for each file and for each mapping inside, in the order of their use."""
    sections: dict[str, str] = {}
    for title, root in roots.items():
        schema = root.model_json_schema()
        inside = schema.pop('$defs', {})
        sections[title] = _section(title, schema)
        waiting = list(_references(schema))
        while waiting:
            name = waiting.pop(0)
            if name not in sections:
                sections[name] = _section(name, inside[name])
                waiting += list(_references(inside[name]))
    return '\n\n'.join(sections.values())


def _references(schema: Any) -> Iterator[str]:
    """Yield the names of the mappings that a schema refers to, in order."""
    if isinstance(schema, dict):
        if '$ref' in schema:
            yield schema['$ref'].rpartition('/')[2]
        for key, value in schema.items():
            if key not in ('default', 'discriminator'):
                yield from _references(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from _references(value)


def _section(title: str, schema: dict[str, Any]) -> str:
    words = _described(schema.get('description', ''))
    lines = [f'## {title}', '', words, '', '| Key | Value | Default |', '|---|---|---|']
    for key, what in schema.get('properties', {}).items():
        asked = key in schema.get('required', ())
        default = 'required' if asked else _default(what)
        lines.append(f'| `{key}` | {_type(what)} | {default} |')
    return '\n'.join(lines)


def _described(text: str) -> str:
    return '\n\n'.join(_cell(part) for part in re.split(r'\n\s*\n', text.strip()))


def _default(what: dict[str, Any]) -> str:
    if 'default' not in what or what['default'] in (None, '', [], {}):
        return 'none'
    if '$ref' in what:
        return 'as below'
    return f'`{json.dumps(what["default"], ensure_ascii=False)}`'.replace('|', '&#124;')


def _type(what: dict[str, Any]) -> str:
    if '$ref' in what:
        name = what['$ref'].rpartition('/')[2]
        return f'[{name}](#{name.lower()})'
    for several in ('anyOf', 'oneOf'):
        if several in what:
            kinds = [_type(each) for each in what[several] if each.get('type') != 'null']
            return ', or '.join(dict.fromkeys(kinds))
    if 'const' in what:
        return f'`{what["const"]}`'
    if 'enum' in what:
        return ', '.join(f'`{value}`' for value in what['enum'])
    kind = what.get('type', '')
    if kind == 'array':
        return _array(what)
    if kind == 'object':
        values = [*what.get('patternProperties', {}).values(), what.get('additionalProperties')]
        inner = ', or '.join(_type(each) for each in values if isinstance(each, dict) and each)
        return f'a name for each: {inner}' if inner else 'a mapping'
    words = {'string': 'text', 'number': 'number', 'integer': 'whole number', 'boolean': 'yes/no'}
    return f'{words.get(kind, "any")}{_range(what)}'


def _array(what: dict[str, Any]) -> str:
    low, high = what.get('minItems'), what.get('maxItems')
    count = f'{low} of: ' if low == high and low else 'list of: '
    return f'{count}{_type(what.get("items", {}))}'


def _range(what: dict[str, Any]) -> str:
    signs = {
        'gt': '>', 'ge': '>=', 'lt': '<', 'le': '<=', 'exclusiveMinimum': '>', 'minimum': '>=',
        'exclusiveMaximum': '<', 'maximum': '<=',
    }  # fmt: skip
    return ''.join(f' {sign} {what[key]:g}' for key, sign in signs.items() if key in what)


def python_names() -> str:
    """Return what ``import fluid_sim_ros`` offers: each public name, its members, their words."""
    parts = []
    for name in fluid_sim_ros.__all__:
        value = getattr(fluid_sim_ros, name)
        parts += [f'## {name}', '', f'```text\n{_signature(value, name)}\n```', '', _words(value)]
        if inspect.isclass(value):
            parts += ['', '| Member | What it is |', '|---|---|', *_members(value)]
        parts.append('')
    return '\n'.join(parts).strip()


def _signature(value: Any, name: str) -> str:
    try:
        found = inspect.signature(value)
    except ValueError:
        return name
    kept = [part for part in found.parameters.values() if part.name != 'self']
    if len(str(found)) > 200:  # the names are enough
        return f'{name}({", ".join(part.name for part in kept)})'
    plain = found.replace(parameters=kept, return_annotation=inspect.Signature.empty)
    shown = re.sub(r'(\w+\.)+(\w+)', r'\2', f'{name}{plain}')
    shown = re.sub(r'ndarray\[.*?\]\]', 'Array', shown)  # as numpy's versions differ in it
    return re.sub(r"': '([^']*)'|(?<=: )'([^']*)'", r'\1\2', shown)


def _words(value: Any) -> str:
    """Return a docstring's words before its sections of parameters and returns."""
    text = inspect.cleandoc(value.__doc__ or '')
    return _described(re.split(r'\n\w+\n-+\n', text)[0])


def _members(value: type) -> Iterator[str]:
    # a simulation gets some of its methods when it is made
    made = Simulation('sphere') if value is Simulation else value
    for name in dir(made):
        member = getattr(value, name, None) or getattr(made, name)
        if name.startswith('_') or not (inspect.isroutine(member) or isinstance(member, property)):
            continue
        shown = name if isinstance(member, property) else _signature(member, name)
        yield f'| `{shown.replace("|", "or")}` | {_words(member).splitlines()[0]} |'


def topic_names() -> dict[str, set[str]]:
    """Return every topic of the node, with ``<v>`` for a vehicle, and its types."""
    settings = {name: declared.default for name, declared in simulator.TABLE.items()}
    found: dict[str, set[str]] = {}
    for scene in TOPIC_SCENES:
        simulation = Simulation(scene)
        topics = [
            *StateTopics(simulation, settings).topics,
            *Commands(simulation, settings).topics,
        ]
        for topic in topics:
            name = topic.name
            for vehicle in simulation.vehicles:
                name = re.sub(rf'^{vehicle}/', '<v>/', name)
            found.setdefault(name, set()).add(topic.type)
    return found
