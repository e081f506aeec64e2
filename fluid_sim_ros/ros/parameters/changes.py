# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Changes of ROS parameters while a node runs: which are accepted."""

from collections.abc import Sequence

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from fluid_sim_ros.errors import listed
from fluid_sim_ros.ros.parameters.table import Declared, Table, check, converted

#: Parameter that lets others set what names a file or an address.
ALLOW_REMOTE_PATHS = 'allow_remote_paths'


def judge(
    node: Node, table: Table, changes: Sequence[Parameter], fixed: str
) -> SetParametersResult:
    """
    Accept or refuse a change at run time.

    Parameters
    ----------
    node
        The node.
    table
        Its parameters by name.
    changes
        What shall be changed.
    fixed
        While what the parameters that are not live keep their values; empty: they may change
        now. To set one to the value that it has (``ros2 param load``) is no change.

    Returns
    -------
    SetParametersResult
        Whether it is accepted, and the reason where it is not.

    """
    for change in changes:
        declared = table.get(change.name)
        if declared is None:
            continue
        fault = check(table, change.name, change.value) or _place_fault(node, declared, change)
        if fault is None and fixed and not declared.live and not _is_same(node, declared, change):
            live = listed(name for name, entry in table.items() if entry.live)
            fault = f"parameter '{change.name}': fixed while {fixed}; changeable: {live}"
        if fault:
            return SetParametersResult(successful=False, reason=fault)
    return SetParametersResult(successful=True)


def _is_same(node: Node, declared: Declared, change: Parameter) -> bool:
    present = converted(declared, node.get_parameter(change.name).value)
    wanted = converted(declared, change.value)
    if isinstance(declared.default, list):
        return list(present) == list(wanted)
    return bool(present == wanted) or (present != present and wanted != wanted)  # both nan


def _place_fault(node: Node, declared: Declared, change: Parameter) -> str | None:
    opens = change.name == ALLOW_REMOTE_PATHS
    if not (opens or declared.names_place):
        return None
    if not opens and node.get_parameter(ALLOW_REMOTE_PATHS).value:
        return None
    if _is_same(node, declared, change):
        return None
    return (
        f"parameter '{change.name}': fixed after the start, because it names a file or an address "
        f"or allows that; start the node with '{ALLOW_REMOTE_PATHS}' to let others set it"
    )
