# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Write models/shapes/unit_sphere.stl, of which the URDF of a vehicle makes its ellipsoids."""

from pathlib import Path

import trimesh

TARGET = Path(__file__).resolve().parents[1] / 'models/shapes/unit_sphere.stl'
#: 1280 triangles: no vertex is off, and no face by more than 0.5 % of the radius.
SUBDIVISIONS = 3


def stl() -> bytes:
    """Return a sphere of radius 1 m as binary STL."""
    made: bytes = trimesh.creation.icosphere(subdivisions=SUBDIVISIONS).export(file_type='stl')
    return made


if __name__ == '__main__':
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_bytes(stl())
