# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The messages and services of simulation_interfaces that the node serves, without their comments.

After the package's version 2 (Apache License 2.0); names and numbers are those of its files.
"""

NEEDS = ('geometry_msgs', 'std_msgs', 'builtin_interfaces', 'service_msgs')
_FEATURES = {
    'ENTITY_STATE_GETTING': 10, 'ENTITY_STATE_SETTING': 11, 'SIMULATION_RESET': 20,
    'SIMULATION_RESET_TIME': 21, 'SIMULATION_STATE_GETTING': 24, 'SIMULATION_STATE_SETTING': 25,
    'SIMULATION_STATE_PAUSE': 26, 'STEP_SIMULATION_SINGLE': 31, 'STEP_SIMULATION_MULTIPLE': 32,
    'SPAWNING': 0, 'DELETING': 1,
}  # fmt: skip
_STATES = ('STOPPED', 'PLAYING', 'PAUSED', 'QUITTING', 'INITIALIZING')
_RESULTS = ('FEATURE_UNSUPPORTED', 'OK', 'NOT_FOUND', 'INCORRECT_STATE', 'OPERATION_FAILED')


def _constants(pairs):
    return ''.join(f'uint8 {name} = {number}\n' for name, number in pairs)


TEXTS = {
    'msg/Result': _constants((f'RESULT_{n}', i) for i, n in enumerate(_RESULTS))
    + 'uint8 result\nstring error_message\n',
    'msg/SimulatorFeatures': _constants(_FEATURES.items())
    + 'uint16[] features\nstring[] spawn_formats\nstring custom_info\n',
    'msg/SimulationState': _constants((f'STATE_{n}', i) for i, n in enumerate(_STATES))
    + 'uint8 state\n',
    'msg/EntityState': 'std_msgs/Header header\ngeometry_msgs/Pose pose\n'
    'geometry_msgs/Twist twist\ngeometry_msgs/Accel acceleration\n',
    'msg/EntityCategory': 'uint8 CATEGORY_OBJECT = 0\nuint8 CATEGORY_ROBOT = 1\nuint8 category\n',
    'msg/TagsFilter': 'uint8 FILTER_MODE_ANY = 0\nuint8 FILTER_MODE_ALL = 1\n'
    'string[] tags\nuint8 filter_mode\n',
    'msg/Bounds': 'uint8 TYPE_EMPTY = 0\nuint8 TYPE_SPHERE = 3\nuint8 type\n'
    'geometry_msgs/Vector3[] points\n',
    'msg/EntityFilters': 'string filter\nEntityCategory[] categories\nTagsFilter tags\n'
    'Bounds bounds\n',
    'srv/GetSimulatorFeatures': '---\nSimulatorFeatures features\n',
    'srv/ResetSimulation': 'uint8 SCOPE_DEFAULT = 0\nuint8 SCOPE_TIME = 1\n'
    'uint8 SCOPE_STATE = 2\nuint8 SCOPE_SPAWNED = 4\nuint8 SCOPE_ALL = 255\nuint8 scope\n---\n'
    'Result result\n',
    'srv/StepSimulation': 'uint64 steps\n---\nResult result\n',
    'srv/GetSimulationState': '---\nSimulationState state\nResult result\n',
    'srv/SetSimulationState': 'SimulationState state\n---\nuint8 ALREADY_IN_TARGET_STATE = 101\n'
    'uint8 STATE_TRANSITION_ERROR = 102\nuint8 INCORRECT_TRANSITION = 103\nResult result\n',
    'srv/GetEntities': 'EntityFilters filters\n---\nResult result\nstring[] entities\n',
    'srv/GetEntitiesStates': 'EntityFilters filters\n---\nResult result\nstring[] entities\n'
    'EntityState[] states\n',
    'srv/GetEntityState': 'string entity\n---\nResult result\nEntityState state\n',
    'srv/SetEntityState': 'string entity\nEntityState state\nbool set_pose\nbool set_twist\n'
    'bool set_acceleration\n---\nResult result\n',
}  # fmt: skip
