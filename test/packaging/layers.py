"""Which part of the package may import which: the rules, and a walk over the imports."""

import ast
from pathlib import Path

PACKAGE = 'fluid_sim_ros'
LEAVES = ('ros', 'mavlink', 'recording', 'lab')
# Read by people through a terminal: they may import anything, and nothing else imports them. So
# may every module whose name begins with cli_.
FRONT_ENDS = ('cli', 'demo', 'doctor', 'headless')
# May stand in any part.
COMMON = ('errors', 'frames')
ROS_MODULES = (
    'rclpy', 'rcl_interfaces', 'rosgraph_msgs', 'std_msgs', 'std_srvs', 'geometry_msgs',
    'nav_msgs', 'sensor_msgs', 'diagnostic_msgs', 'visualization_msgs', 'lifecycle_msgs',
    'builtin_interfaces', 'tf2_msgs', 'launch', 'launch_ros',
)  # fmt: skip
# What a part may not import from outside the package.
FOREIGN = {
    'physics': ('mujoco', *ROS_MODULES),
    'control': ('mujoco', *ROS_MODULES),
    'core': ROS_MODULES,
    'lab': ROS_MODULES,
    'mavlink': ROS_MODULES,
    'recording': ROS_MODULES,
}


def part_of(module: str) -> str:
    """Return the part that a module of the package belongs to: a leaf, a front end, or core."""
    first = module.removeprefix(PACKAGE).lstrip('.').split('.')[0]
    if first.startswith('cli_'):
        return 'cli'
    if first in (*LEAVES, *FRONT_ENDS, *COMMON, 'physics', 'control'):
        return first
    return 'core'


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
    """Return why a part may not import a module, or nothing."""
    part = part_of(importer)
    if part in FRONT_ENDS:
        return ''
    outer = imported.split('.')[0]
    if outer != PACKAGE:
        return f'{part} may not use {outer}' if outer in FOREIGN.get(part, ()) else ''
    target = part_of(imported)
    if target in COMMON or target == part:
        return ''
    if part in COMMON:
        return f'{part} may import nothing of the package'
    if target in FRONT_ENDS:
        return f'nothing may import {target}'
    if part in ('physics', 'control'):
        return f'{part} may not import {target}' if target != 'physics' else ''
    if target in LEAVES:
        return f'{part} may not import the leaf {target}'
    return ''


def violations(root: Path) -> list[str]:
    """Return one line per forbidden import in the package below ``root``."""
    lines = []
    for path in sorted((root / PACKAGE).rglob('*.py')):
        relative = path.relative_to(root).with_suffix('')
        module = '.'.join(relative.parts).removesuffix('.__init__')
        for line, imported in imports(path, module):
            reason = fault(module, imported)
            if reason:
                lines.append(f'{path.relative_to(root)}:{line}: {imported}: {reason}')
    return lines
