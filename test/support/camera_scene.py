# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A scene with a small camera on a quadrotor, as a file."""

TEXT = """\
model: x500
keyframe: hover
duration: {duration}
vehicles:
  x500:
    body: x500
    thrusters: [m1, m2, m3, m4]
    sensors:
      camera: {{site: camera, rate: 10, width: 64, height: 48, depth: true, latency: 0.02}}
      lidar: {{rate: 10, beams: 16, angles: [-30, 30]}}
"""


def camera_scene(folder, duration=1.0):
    """Write the file; return its path."""
    path = folder / 'camera.yaml'
    path.write_text(TEXT.format(duration=duration))
    return path
