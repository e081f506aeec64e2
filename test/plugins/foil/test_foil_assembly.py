# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Foils beside bodies with added mass."""

import mujoco
import numpy as np

from test.support.foil_models import foil_world
from test.support.plugin_models import body_plugin, load

BODY = {'added_mass': [1, 2, 3, 0.1, 0.2, 0.3], 'quadratic_damping': [5, 6, 7, 1, 1, 1]}


def vehicle(*, foil, body):
    """Return a hull with or without a foil and with or without added mass."""
    inside = body_plugin(**BODY) if body else ''
    xml = foil_world({'span': 0.5, 'chord': 0.1}, inside=inside, medium={'density': 1000})
    xml = xml.replace('<body name="hull">', '<body name="hull" simple="false">')
    if body:
        xml = xml.replace('<extension>', '<extension><plugin plugin="fluid_sim.body"/>')
    if not foil:
        first = xml.index('<plugin plugin="fluid_sim.foil">')
        xml = xml[:first] + xml[xml.index('</extension>') :]
    model, data = load(xml)
    data.qvel[:] = [2, 0.1, -0.2, 0.3, 0.2, 0.1]
    mujoco.mj_forward(model, data)
    return model, data


def test_forces_of_foil_and_body_add_up_and_the_inertia_is_the_bodys():
    model, both = vehicle(foil=True, body=True)
    _, foil = vehicle(foil=True, body=False)
    _, body = vehicle(foil=False, body=True)
    np.testing.assert_allclose(
        both.qfrc_passive, foil.qfrc_passive + body.qfrc_passive, rtol=1e-13
    )
    np.testing.assert_array_equal(both.M, body.M)
    mass = np.zeros((6, 6))
    mujoco.mj_fullM(model, both, mass)
    np.testing.assert_allclose(mass @ both.qacc, both.qfrc_passive - both.qfrc_bias, atol=1e-9)
