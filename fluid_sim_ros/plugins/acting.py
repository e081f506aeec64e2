# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which terms of the fluid wrench can act on the bodies of a model, known when it is loaded."""

from collections.abc import Iterable, Mapping

import mujoco
import numpy as np

from fluid_sim_ros.plugins.native import native


def acting_terms(
    model: mujoco.MjModel, body_ids: Iterable[int], data: mujoco.MjData | None = None
) -> dict[int, tuple[str, ...]]:
    """
    Return the terms that can act on each body, by the plugins and by MuJoCo's own fluid forces.

    A term can act when some motion of the body makes it other than zero: its coefficients are not
    all 0, and a fluid of the model has the density or the viscosity that it needs. An empty tuple
    is a body that feels no fluid at all: it moves as in vacuum, whatever wind or current there is.

    Parameters
    ----------
    model
        The compiled model.
    body_ids
        Ids of the bodies that are asked about.
    data
        Of that model, if there is one already; its state does not matter and stays.

    Returns
    -------
    acting
        Body id -> names in the order of ``native.TERMS``.

    """
    library, data = native(), data or mujoco.MjData(model)
    acts = np.zeros(len(library.terms), dtype=np.int32)
    acting = {}
    for body in body_ids:
        library.acting_terms(model._address, data._address, int(body), acts.ctypes.data)
        acting[int(body)] = tuple(
            term for term, can in zip(library.terms, acts.tolist(), strict=True) if can
        )
    return acting


def terms_together(acting: Mapping[int, tuple[str, ...]]) -> tuple[str, ...]:
    """
    Return the terms that act on any of the bodies, each once.

    Parameters
    ----------
    acting
        Body id -> terms, as ``acting_terms`` returns it.

    Returns
    -------
    terms
        Names in the order of ``native.TERMS``.

    """
    found = {term for terms in acting.values() for term in terms}
    return tuple(term for term in native().terms if term in found)
