# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is tied to a vehicle without being part of it: a tether, a slung load, the cord between."""

import itertools
from collections.abc import Collection, Iterator

import mujoco

_TIES = (int(mujoco.mjtEq.mjEQ_CONNECT), int(mujoco.mjtEq.mjEQ_WELD))


def tied_bodies(model: mujoco.MjModel, base: int, others: Collection[int] = ()) -> list[int]:
    """
    Return the bodies that equalities or spatial tendons tie to a vehicle's tree, tree by tree.

    Parameters
    ----------
    model
        The model.
    base
        Body of the vehicle.
    others
        Bases of other vehicles: their trees are theirs.

    Returns
    -------
    list
        Body ids, rising; without the vehicle's own.

    """
    root = model.body_rootid
    foreign = {int(root[body]) for body in others} | {0}
    own = int(root[base])
    found, edges = {own}, list(_edges(model))
    while grown := {b for pair in edges for b in pair if set(pair) & found} - foreign - found:
        found |= grown
    return [b for b in range(1, model.nbody) if root[b] in found and root[b] != own]


def cords(model: mujoco.MjModel, bodies: Collection[int]) -> dict[int, list[int]]:
    """
    Return the spatial tendons on bodies, as the sites that they lead through.

    Parameters
    ----------
    model
        The model.
    bodies
        Body ids.

    Returns
    -------
    dict
        Tendon id -> two or more site ids. A tendon that goes around geoms is drawn straight from
        site to site; one with a site on none of the bodies is left out.

    """
    found = {}
    for tendon in range(model.ntendon):
        sites = _sites(model, tendon)
        if len(sites) > 1 and all(model.site_bodyid[site] in bodies for site in sites):
            found[tendon] = sites
    return found


def _sites(model: mujoco.MjModel, tendon: int) -> list[int]:
    first = model.tendon_adr[tendon]
    wraps = range(first, first + model.tendon_num[tendon])
    return [
        int(model.wrap_objid[i]) for i in wraps
        if model.wrap_type[i] == mujoco.mjtWrap.mjWRAP_SITE
    ]  # fmt: skip


def _edges(model: mujoco.MjModel) -> Iterator[tuple[int, int]]:
    """Yield the roots of the trees that are tied to each other."""
    root = model.body_rootid
    for i in range(model.neq):
        if int(model.eq_type[i]) in _TIES:
            ends = [int(model.eq_obj1id[i]), int(model.eq_obj2id[i])]
            if model.eq_objtype[i] == mujoco.mjtObj.mjOBJ_SITE:
                ends = [int(model.site_bodyid[site]) for site in ends]
            yield int(root[ends[0]]), int(root[ends[1]])
    for tendon in range(model.ntendon):
        bodies = [int(root[model.site_bodyid[site]]) for site in _sites(model, tendon)]
        yield from itertools.pairwise(bodies)
