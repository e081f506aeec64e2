# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Stands in for ROS's packages launch and launch_ros, which are not among the wheels.

It loads a launch file as ``ros2 launch`` does and says what would be started. It knows only what
our launch files use; where the real packages are, ``test_launch_files.py`` uses those, too.
"""

import sys
import types
from dataclasses import dataclass, field
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from typing import Any


class Substitution:
    def perform(self, context):
        raise NotImplementedError


@dataclass
class LaunchConfiguration(Substitution):
    name: str

    def perform(self, context):
        return context[self.name]


class ThisLaunchFileDir(Substitution):
    def perform(self, context):
        return context['this folder']


@dataclass
class ExecutableInPackage(Substitution):
    executable: str
    package: str

    def perform(self, context):
        return context['executables'][self.package, self.executable]


def text_of(value, context):
    """Return a text, a substitution or a list of them as text."""
    parts = value if isinstance(value, list | tuple) else [value]
    return ''.join(p.perform(context) if isinstance(p, Substitution) else p for p in parts)


@dataclass
class DeclareLaunchArgument:
    name: str
    default_value: Any = None
    description: str = ''
    choices: Any = None

    def start(self, context):
        value = context.setdefault(self.name, text_of(self.default_value, context))
        if self.choices is not None and value not in self.choices:
            raise RuntimeError(f'{self.name}: {value}: allowed: {self.choices}')
        return []


@dataclass
class SetEnvironmentVariable:
    name: str
    value: str

    def start(self, context):
        return []


@dataclass
class OpaqueFunction:
    function: Any

    def start(self, context):
        return [node for made in self.function(context) for node in made.start(context)]


@dataclass
class Shutdown:
    reason: str = ''


@dataclass
class IfCondition:
    value: Substitution


@dataclass
class IncludeLaunchDescription:
    source: list
    launch_arguments: list = field(default_factory=list)
    condition: IfCondition | None = None

    def start(self, context):
        if self.condition and self.condition.value.perform(context) != 'true':
            return []
        given = {name: text_of(value, context) for name, value in self.launch_arguments}
        path = Path(text_of(self.source, context))
        return started(path, {**context, **given})


@dataclass
class ParameterValue:
    value: Any
    value_type: type | None = None


@dataclass
class Node:
    package: str
    executable: str
    name: str | None = None
    namespace: str | None = None
    parameters: list = field(default_factory=list)
    remappings: list = field(default_factory=list)
    arguments: list = field(default_factory=list)
    output: str = 'log'
    on_exit: Shutdown | None = None

    def start(self, context):
        self.given = {}
        for each in self.parameters:
            if isinstance(each, str):
                self.given['file'] = each
                continue
            for name, value in each.items():
                plain = value.value if isinstance(value, ParameterValue) else value
                made = isinstance(plain, Substitution)
                self.given[name] = plain.perform(context) if made else plain
        return [self]


@dataclass
class LaunchDescription:
    entities: list


_MODULES = {
    'launch': (LaunchDescription,),
    'launch.actions': (
        DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction, SetEnvironmentVariable,
        Shutdown,
    ),
    'launch.conditions': (IfCondition,),
    'launch.substitutions': (LaunchConfiguration, ThisLaunchFileDir),
    'launch_ros': (),
    'launch_ros.actions': (Node,),
    'launch_ros.parameter_descriptions': (ParameterValue,),
    'launch_ros.substitutions': (ExecutableInPackage,),
}  # fmt: skip


def install(monkeypatch):
    """Have ``import launch`` and ``import launch_ros`` find the classes of this file."""
    for name, members in _MODULES.items():
        module = types.ModuleType(name)
        for member in members:
            setattr(module, member.__name__, member)
        monkeypatch.setitem(sys.modules, name, module)
    sources = types.ModuleType('launch.launch_description_sources')
    sources.PythonLaunchDescriptionSource = list
    monkeypatch.setitem(sys.modules, sources.__name__, sources)


def description_of(path):
    """Return what a launch file's ``generate_launch_description`` returns."""
    loader = SourceFileLoader('python_launch_file', str(path))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module.generate_launch_description()


def arguments_of(path):
    """Return the arguments that a launch file declares."""
    entities = description_of(path).entities
    return [each for each in entities if isinstance(each, DeclareLaunchArgument)]


def started(path, context):
    """Return the nodes that a launch file starts."""
    context = {**context, 'this folder': str(path.parent)}
    return [node for entity in description_of(path).entities for node in entity.start(context)]
