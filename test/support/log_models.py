# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A model of one body, with whatever else a test wants in it."""

BODY = (
    '<body name="b"><freejoint/><geom name="g" size=".1" {geom}/>{more}</body><camera name="c"/>'
)


def body_model(asset='', more='', head='', geom='', inner=''):
    """Return MJCF: assets, what stands in the world, before all, on the geom, in the body."""
    body = BODY.format(geom=geom, more=inner)
    world = f'<worldbody>{body}{more}</worldbody>'
    return f'<mujoco>{head}<asset>{asset}</asset>{world}</mujoco>'.encode()
