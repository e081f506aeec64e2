# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The potential flow of a moving body, by the boundary-element method with Capytaine.

Direct method (potential as unknown) with constant panels: (1/2 + K) phi = S n, Hess and Smith
(1964), J. Ship Res. 8(2); Capytaine evaluates S and K of the Rankine source 1/r. A = -rho oint phi
n_j dS for unit motions in x y z roll pitch yaw (Newman 1977, ch. 4). Planes are mirrors: an image
of the body with the same sign beside a wall, with the other sign under a free surface at infinite
frequency (phi = 0 there).
"""

import logging
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.hydro.planes import Image
from fluid_sim_ros.physics.arrays import Array

#: Rows of the matrices that are evaluated at once.
_ROWS = 512
#: Of the way from a panel's centre to its first corner.
_ASIDE = 1e-3
_NO_SOLUTION = (
    'the panels of the mesh overlap or are needles: no finite solution; mend or simplify the mesh '
    'in a modelling program'
)


class BoundaryElementError(FluidSimError):
    """The panels of a body give no solution."""


@dataclass(frozen=True)
class PanelGeometry:
    """
    Centre, normal and area of each panel.

    Attributes
    ----------
    centers, normals
        Shape (n, 3).
    areas
        Shape (n,).

    """

    centers: Array
    normals: Array
    areas: Array

    def motions(self, point: Array) -> Array:
        """
        Return the normal velocity of each panel in the six unit motions.

        Parameters
        ----------
        point
            About which the body turns, shape (3,).

        Returns
        -------
        Shape (n, 6): x y z [-], roll pitch yaw [length].

        """
        moments = np.cross(self.centers - point, self.normals)
        return np.concatenate([self.normals, moments], axis=1)


def _mesh(panels: Array) -> Any:
    import capytaine

    faces = np.arange(4 * len(panels)).reshape(-1, 4)
    three = (panels[:, 2] == panels[:, 3]).all(axis=1)
    faces[three, 3] = faces[three, 0]
    return capytaine.Mesh(panels.reshape(-1, 3), faces, auto_clean=False, auto_check=False)


def added_mass_of_panels(panels: Array, point: Array, images: list[Image]) -> Array:
    """
    Return the added mass of a body per density of the fluid.

    Parameters
    ----------
    panels
        Corners, seen from outside counter-clockwise; three-cornered ones with the last twice;
        shape (n, 4, 3) [length].
    point
        About which A is stated, shape (3,).
    images
        The body's mirror images (`hydro.planes`); none: unbounded fluid.

    Returns
    -------
    A over rho, not made symmetric, shape (6, 6): [length^3], [length^4], [length^5].

    Raises
    ------
    BoundaryElementError
        If the matrix has no finite solution.

    """
    import capytaine

    # it would tell of tables that are not used here
    logging.getLogger('capytaine').setLevel(logging.ERROR)
    kernel = capytaine.Delhommeau(tabulation_nr=0, tabulation_nz=0, tabulation_cache_dir=None)
    mesh = _mesh(panels)
    geometry = PanelGeometry(
        np.array(mesh.faces_centers), np.array(mesh.faces_normals), np.array(mesh.faces_areas)
    )
    motions = geometry.motions(point)
    count = len(panels)
    double = np.empty((count, count), order='F')
    right = np.zeros((count, motions.shape[1]))
    mirrored = [(_mesh(image.of_panels(panels)), image) for image in images]
    # where parts touch in a line, a centre may lie on the side of another panel
    beside = geometry.centers + _ASIDE * (panels[:, 0] - geometry.centers)
    for first in range(0, count, _ROWS):
        rows = slice(first, first + _ROWS)
        single, own = _kernels(kernel, geometry.centers[rows], beside[rows], mesh)
        right[rows] = single @ motions
        # a closed body fills half of all directions seen from a flat panel on it: Gauss's theorem
        # replaces the panel's view of itself, which quadrature of the others leaves inexact
        number = np.arange(own.shape[0])
        own[number, first + number] = 0.0
        own[number, first + number] = 1.0 - own.sum(axis=1)
        for image_mesh, image in mirrored:
            single, other = _kernels(kernel, geometry.centers[rows], beside[rows], image_mesh)
            right[rows] += image.sign * (single @ motions)
            own += image.sign * other
        double[rows] = own
    if not (np.isfinite(double).all() and np.isfinite(right).all()):
        raise BoundaryElementError(_NO_SOLUTION)
    potential = lu_solve(lu_factor(double, overwrite_a=True, check_finite=False), right)
    matrix: Array = -(motions * geometry.areas[:, None]).T @ potential
    return matrix


def _kernels(kernel: Any, points: Array, beside: Array, mesh: Any) -> tuple[Array, Array]:
    """Return single and double layer of panels at points, or at those beside them."""
    from capytaine.green_functions.abstract_green_function import GreenFunctionEvaluationError

    for places in (points, beside):
        try:
            single, double = kernel.evaluate_rankine_only(
                places, mesh, adjoint_double_layer=False, diagonal_term_in_double_layer=False
            )
        except GreenFunctionEvaluationError:
            continue
        return np.ascontiguousarray(single), np.ascontiguousarray(double)
    raise BoundaryElementError(_NO_SOLUTION)
