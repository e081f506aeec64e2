# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which geoms light passes through: bodies of water, drawn so that one sees into them."""

import mujoco
import numpy as np
from numpy.typing import NDArray

#: A geom without a colour of its own has this one, and its material's is drawn.
_DEFAULT = np.array([0.5, 0.5, 0.5, 1.0], dtype=np.float32)


def translucent_geoms(model: mujoco.MjModel) -> NDArray[np.bool_]:
    """
    Return which geoms are drawn with an opacity below 1.

    Parameters
    ----------
    model
        The compiled model.

    Returns
    -------
    NDArray
        Shape (ngeom,).

    """
    opacity = model.geom_rgba[:, 3].copy()
    of_material = (model.geom_matid >= 0) & (model.geom_rgba == _DEFAULT).all(axis=1)
    opacity[of_material] = model.mat_rgba[model.geom_matid[of_material], 3]
    result: NDArray[np.bool_] = opacity < 1.0
    return result
