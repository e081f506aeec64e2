# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The order of the package's rooms: which may import which, and a walk over the imports."""

import ast
from pathlib import Path

PACKAGE = 'fluid_sim_ros'
#: Lowest first: a room imports only rooms before it, and itself.
ORDER = (
    'errors', 'resources', 'interruption', 'step_clock', 'output',
    'physics', 'control', 'plugins',
    'schema', 'hydro', 'scene', 'simulation', 'sensors', 'messages', 'loop', 'flights',
    'new_vehicle', 'lab', 'sweep', 'reality', 'recording', 'mavlink', 'view', 'foxglove', 'ros',
    'demo', 'cli',
)  # fmt: skip
#: None of these imports another.
LEAVES = (
    'new_vehicle',
    'lab',
    'sweep',
    'reality',
    'recording',
    'mavlink',
    'view',
    'foxglove',
    'ros',
)
#: The package's own names that stand in its ``__init__`` itself; the rest it hands on.
OF_THE_PACKAGE = ('__version__',)
ROS_MODULES = (
    'rclpy', 'rcl_interfaces', 'rosgraph_msgs', 'std_msgs', 'std_srvs', 'geometry_msgs',
    'nav_msgs', 'sensor_msgs', 'diagnostic_msgs', 'visualization_msgs', 'lifecycle_msgs',
    'builtin_interfaces', 'tf2_msgs', 'simulation_interfaces', 'launch', 'launch_ros',
)  # fmt: skip
#: Rooms that may use ROS; those that know nothing of MuJoCo.
KNOW_ROS = ('ros', 'demo', 'cli')
WITHOUT_MUJOCO = (
    'errors',
    'resources',
    'interruption',
    'step_clock',
    'output',
    'physics',
    'hydro',
    'control',
)


def room_of(module: str) -> str:
    """Return the room that a module of the package stands in; '' for the package itself."""
    return module.removeprefix(PACKAGE).lstrip('.').split('.')[0]


def imports(path: Path, module: str) -> list[tuple[int, str]]:
    """Return (line, imported module) for every import of a file, also those inside functions."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ''
            if node.level:
                package = module if path.name == '__init__.py' else module.rpartition('.')[0]
                parents = package.split('.')[: len(package.split('.')) - node.level + 1]
                base = '.'.join([*parents, base]).rstrip('.')
            # `from package import name` may import a module: judge the longest form
            found += [(node.lineno, f'{base}.{alias.name}') for alias in node.names]
    return found


def fault(importer: str, imported: str) -> str:
    """Return why a module may not import another, or nothing."""
    room = room_of(importer)
    outer = imported.split('.')[0]
    if outer != PACKAGE:
        if outer in ROS_MODULES and room not in KNOW_ROS:
            return f'{room} may not use {outer}'
        if outer == 'mujoco' and room in WITHOUT_MUJOCO:
            return f'{room} may not use mujoco'
        return ''
    target = room_of(imported)
    if target in (room, *OF_THE_PACKAGE):
        return ''
    if target not in ORDER:
        return f'{target or PACKAGE} is no room: import from where the name stands'
    if room in LEAVES and target in LEAVES:
        return f'the leaf {room} may not import the leaf {target}'
    if ORDER.index(target) > ORDER.index(room):
        return f'{target} stands above {room}'
    return ''


def violations(root: Path) -> list[str]:
    """Return one line per forbidden import in the package below ``root``."""
    lines = []
    for path in sorted((root / PACKAGE).rglob('*.py')):
        relative = path.relative_to(root).with_suffix('')
        module = '.'.join(relative.parts).removesuffix('.__init__')
        if module == PACKAGE:  # hands on its public names, on first use
            continue
        if room_of(module) not in ORDER:
            lines.append(f'{path.relative_to(root)}: {room_of(module)} is no room')
            continue
        for line, imported in imports(path, module):
            reason = fault(module, imported)
            if reason:
                lines.append(f'{path.relative_to(root)}:{line}: {imported}: {reason}')
    return lines


def dynamic_imports(root: Path) -> set[str]:
    """Return the package's modules that a string names, for ``import_module`` or ``python -m``."""
    named = set()
    for path in (root / PACKAGE).rglob('*.py'):
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
            if (
                isinstance(node, ast.Constant)
                and isinstance(node.value, str)
                and node.value.startswith(f'{PACKAGE}.')
                and all(part.isidentifier() for part in node.value.split('.'))
            ):
                named.add(node.value)
    return named


def circles(root: Path) -> list[list[str]]:
    """Return every circle of imports between modules, those inside functions left out."""
    graph: dict[str, set[str]] = {}
    for path in (root / PACKAGE).rglob('*.py'):
        relative = path.relative_to(root).with_suffix('')
        module = '.'.join(relative.parts).removesuffix('.__init__')
        graph[module] = set()
        for statement in ast.parse(path.read_text(encoding='utf-8')).body:
            if isinstance(statement, ast.ImportFrom) and not statement.level:
                for alias in statement.names:
                    graph[module] |= {statement.module or '', f'{statement.module}.{alias.name}'}
            elif isinstance(statement, ast.Import):
                graph[module] |= {alias.name for alias in statement.names}
    found: list[list[str]] = []
    state: dict[str, int] = {}

    def visit(module: str, trail: list[str]) -> None:
        state[module] = 1
        for target in sorted(graph[module] & graph.keys()):
            if state.get(target) == 1:
                found.append([*trail[trail.index(target) :], target])
            elif target not in state:
                visit(target, [*trail, target])
        state[module] = 2

    for module in sorted(graph):
        if module not in state:
            visit(module, [module])
    # a package that hands on a name of a module of its own is no circle
    return [circle for circle in found if not all(_same_package(circle[0], m) for m in circle)]


def _same_package(package: str, module: str) -> bool:
    return module == package or module.startswith(f'{package}.')
