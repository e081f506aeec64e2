# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What the docstrings of the package's public functions lack, found in the source text.

``python -m test.packaging.docstrings [ROOM ...]`` lists it.
"""

import ast
import inspect
import re
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from test.support.paths import ROOT

Function = ast.FunctionDef | ast.AsyncFunctionDef
_SECTION = re.compile(r'^(\w[\w ]*)\n-{3,}\n', re.MULTILINE)
#: Decorators under which a function is read as a value, or is declared a second time.
_NOT_CALLED = {'property', 'cached_property', 'overload', 'setter'}


def is_public(path: Path) -> bool:
    """Return whether all folders and the module of a path have public names."""
    return not any(
        part.startswith('_') and part != '__init__' for part in path.with_suffix('').parts
    )


def sections(docstring: str) -> dict[str, str]:
    """Return the text of each section of a numpy-style docstring, by its title."""
    parts = _SECTION.split(inspect.cleandoc(docstring))
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def entries(section: str) -> set[str]:
    """Return the names that a section explains; ``a, b`` are two."""
    heads = (line for line in section.splitlines() if line and not line[0].isspace())
    return {name.strip().lstrip('*') for head in heads for name in head.split(':')[0].split(',')}


def parameters(function: Function) -> list[str]:
    """Return the names of a function's parameters, without ``self`` and private ones."""
    given = function.args
    names = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
    found = [argument.arg for argument in names if argument]
    return [name for name in found if name not in ('self', 'cls') and name[0] != '_']


def decorators(function: Function) -> set[str]:
    """Return the last word of each decorator."""
    bare = [d.func if isinstance(d, ast.Call) else d for d in function.decorator_list]
    return {ast.unparse(decorator).rsplit('.')[-1] for decorator in bare}


def lacks(function: Function, docstring: str | None) -> list[str]:
    """Return what the docstring of one function leaves out."""
    if docstring is None:
        return ['a docstring']
    found, missing = sections(docstring), []
    explained = entries(found.get('Parameters', ''))
    unnamed = [name for name in parameters(function) if name not in explained]
    if unnamed:
        missing.append(f'Parameters: {", ".join(unnamed)}')
    returned = ast.unparse(function.returns) if function.returns else 'None'
    says_so = re.match(r'(Return|Yield)', inspect.cleandoc(docstring))
    silent = returned in ('None', 'NoReturn', 'Never')
    if not silent and not says_so and not {'Returns', 'Yields'} & set(found):
        missing.append('Returns')
    return missing


def public_functions(tree: ast.Module) -> Iterator[tuple[str, Function, str | None]]:
    """Yield name, definition and docstring of each function, method and constructor."""
    for node in tree.body:
        if isinstance(node, Function):
            if node.name[0] != '_' and not decorators(node) & _NOT_CALLED:
                yield node.name, node, ast.get_docstring(node)
        elif isinstance(node, ast.ClassDef) and node.name[0] != '_':
            for member in node.body:
                if not isinstance(member, Function) or decorators(member) & _NOT_CALLED:
                    continue
                own = ast.get_docstring(member)
                if member.name == '__init__':
                    yield node.name, member, f'{ast.get_docstring(node)}\n\n{own or ""}'
                elif member.name[0] != '_':
                    yield f'{node.name}.{member.name}', member, own


def base_classes(trees: Iterable[ast.Module]) -> dict[str, set[str]]:
    """Return the names of the bases of each class."""
    return {
        node.name: {ast.unparse(base).rsplit('.')[-1].split('[')[0] for base in node.bases}
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    }


def ancestors(name: str, bases: dict[str, set[str]]) -> set[str]:
    """Return the names of all classes that a class inherits from."""
    found = set(bases.get(name, ()))
    return found.union(*(ancestors(base, bases) for base in found))


def faults(package: Path) -> list[str]:
    """
    Return a line for each public function of a package that says too little.

    A method that a class inherits and defines anew need not repeat what its parent says.
    """
    paths = [
        path for path in sorted(package.rglob('*.py')) if is_public(path.relative_to(package))
    ]
    trees = {path: ast.parse(path.read_text(encoding='utf-8')) for path in paths}
    bases, complete = base_classes(trees.values()), set()
    found = []
    for path, tree in trees.items():
        for name, function, docstring in public_functions(tree):
            missing = lacks(function, docstring)
            where = f'{path.relative_to(package)}:{function.lineno} {name}'
            found.append((name, [f'{where} lacks {what}' for what in missing]))
            if not missing:
                complete.add(name)
    lines = []
    for name, missing in found:
        owner, _, method = name.partition('.')
        if not any(f'{parent}.{method}' in complete for parent in ancestors(owner, bases)):
            lines += missing
    return lines


if __name__ == '__main__':
    for line in faults(ROOT / 'fluid_sim_ros'):
        if not sys.argv[1:] or re.split(r'[/.]', line)[0] in sys.argv[1:]:
            print(line)
