# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the links of a URDF are, by readers that are not ours."""

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from test.support.paths import ROOT

SPHERE = (ROOT / 'models/shapes/unit_sphere.stl').read_bytes()


def by_urdf_parser(urdf, positions):
    """
    Return link -> (place [m], rotation matrix) in the root link.

    By the package urdf_parser_py, which also ROS's own tools use; ``positions`` holds that of
    each joint by its name.
    """
    from urdf_parser_py.urdf import URDF

    robot = URDF.from_xml_string(urdf.encode())
    poses = {robot.get_root(): (np.zeros(3), np.eye(3))}
    waiting = list(robot.joints)
    while waiting:
        joint = waiting.pop(0)
        if joint.parent not in poses:
            waiting.append(joint)
            continue
        place, turn = poses[joint.parent]
        place = place + turn @ np.array(joint.origin.xyz)
        turn = turn @ Rotation.from_euler('xyz', joint.origin.rpy).as_matrix()
        at = positions.get(joint.name, 0.0)
        if joint.type in ('revolute', 'continuous'):
            turn = turn @ Rotation.from_rotvec(at * np.array(joint.axis)).as_matrix()
        elif joint.type == 'prismatic':
            place = place + turn @ (at * np.array(joint.axis))
        elif joint.type == 'floating':
            turn = turn @ Rotation.from_quat(at, scalar_first=True).as_matrix()
        poses[joint.child] = (place, turn)
    return robot, poses


def by_mujoco(urdf, positions, assets=()):
    """Return the compiled model, and link -> (place, rotation matrix), by MuJoCo's URDF reader."""
    # it refuses links that move without mass, such as those between two joints of one body
    options = (
        '<mujoco><compiler fusestatic="false" discardvisual="false" boundmass="2e-15" '
        'boundinertia="2e-15"/></mujoco>\n  <link'
    )
    text = urdf.replace('<link', options, 1)
    model = mujoco.MjModel.from_xml_string(text, {'unit_sphere.stl': SPHERE, **dict(assets)})
    data = mujoco.MjData(model)
    for name, at in positions.items():
        joint = model.joint(name)
        # the reader takes a floating joint for a free one: its place, then its turn
        free = joint.type[0] == mujoco.mjtJoint.mjJNT_FREE
        joint_qpos = data.joint(name).qpos
        joint_qpos[3 if free else 0 :] = at
    mujoco.mj_kinematics(model, data)
    return model, {
        model.body(i).name: (data.xpos[i].copy(), data.xmat[i].reshape(3, 3).copy())
        for i in range(1, model.nbody)
    }
