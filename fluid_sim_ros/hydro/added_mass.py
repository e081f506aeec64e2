# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Added mass of a closed body, with its error, from two meshes of panels.

Two meshes whose panels are alike give A(h) and A(h/2); the error falls like h^2 and Richardson's
A(h/2) + (A(h/2) - A(h))/3 takes most of it off; twice that step is stated as its error. Each is
first multiplied by the ratio of the body's volume to that of its panels. A smooth body of many
faces is computed with these and is not extrapolated: a second mesh gives the error only.
"""

import time
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.hydro.meshes.repair import Solid
from fluid_sim_ros.hydro.meshes.surface import volume_and_center
from fluid_sim_ros.hydro.panels import COARSE, panels_of
from fluid_sim_ros.hydro.planes import Image, Plane, check_clear, images_of
from fluid_sim_ros.hydro.potential import added_mass_of_panels
from fluid_sim_ros.hydro.quads import three_cornered
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.matrix6 import rotate_matrix6, shift_reference_point

#: Of the geometric mean of two diagonal entries: no error is stated below it. It is what bodies
#: with known values were found to be off by (benchmarks/hydro/hydro_accuracy.py).
LEAST_ERROR = 0.01
_ORDER = 2
#: Error over Richardson's step: two unlike meshes of a frame differ by less (doc/hydro.md).
_SAFETY = 2.0
#: Lowest eigenvalue over the highest of what is returned: positive definite, also for a sphere,
#: whose added moments of inertia are 0.
_LOWEST = 1e-9


@dataclass(frozen=True)
class AddedMass:
    """
    The added mass of a body.

    Attributes
    ----------
    matrix
        A, order and signs of ``fluid_sim.body``, mesh axes, about ``point``; symmetric and
        positive definite; shape (6, 6): [kg], [kg m], [kg m^2].
    error
        Estimated error of each entry, same shape and units.
    point
        Reference point, mesh axes [m], shape (3,).
    panels
        Number of panels of the coarser and the finer mesh.
    levels
        A of the coarser and the finer mesh, for the record, shape (2, 6, 6).
    volume_ratio
        Volume of the body over that of the finer panels.
    seconds
        Wall time of the computation.
    triangles
        The finer panels as triangles, mesh axes [m], shape (m, 3, 3).

    """

    matrix: Array
    error: Array
    point: Array
    panels: tuple[int, int]
    levels: Array
    volume_ratio: float
    seconds: float
    triangles: Array

    def about(self, point: Array) -> 'AddedMass':
        """
        Return the same added mass about another point.

        Parameters
        ----------
        point
            Mesh axes [m], shape (3,).

        Returns
        -------
        AddedMass
            With errors that bound those of the sums.

        """
        offset = point - self.point
        matrix = shift_reference_point(self.matrix, offset)
        arm = np.abs(shift_reference_point(np.eye(6), offset))  # of H: see matrix6
        step = np.eye(6)
        step[:3, 3:] = arm[:3, 3:]
        return AddedMass(
            0.5 * (matrix + matrix.T), step.T @ self.error @ step, np.array(point, dtype=float),
            self.panels, shift_reference_point(self.levels, offset), self.volume_ratio,
            self.seconds, self.triangles,
        )  # fmt: skip


def added_mass_of_body(
    solid: Solid, density: float, planes: list[Plane] | None = None, coarse: int = COARSE
) -> AddedMass:
    """
    Return the added mass of a closed body about its centre of buoyancy.

    Parameters
    ----------
    solid
        The body.
    density
        Of the fluid [kg/m^3].
    planes
        That bound the fluid (wall, bed, surface); None: unbounded.
    coarse
        Most panels of the coarser mesh; the finer one has four times as many.

    Returns
    -------
    AddedMass
        In mesh axes.

    Raises
    ------
    ConfigError
        If a plane touches the body, or the planes do not fit together.

    """
    began = time.monotonic()
    bounds = planes or []
    check_clear(bounds, solid.in_mesh_axes().vertices)
    images = _in_frame(images_of(bounds), solid)
    volume, center = volume_and_center(solid.surface.triangles)
    # every image costs as much as the body
    panels = panels_of(solid.surface, int(coarse / np.sqrt(1 + len(images))))
    ratios, levels = [], []
    for mesh in (panels.coarse, panels.fine):
        ratios.append(volume / volume_and_center(_as_triangles(mesh))[0])
        levels.append(ratios[-1] * added_mass_of_panels(mesh, center, images))
    coarser, finer = levels
    step = (finer - coarser) / (2**_ORDER - 1)
    best = finer + step if panels.alike else finer
    size = _scale(solid.frame.length) * density
    matrix = _symmetric(best)
    error = np.maximum(_SAFETY * np.abs(step), np.abs(best - best.T))
    rotation = solid.frame.rotation
    result = _symmetric(rotate_matrix6(_definite(matrix) * size, rotation))
    diagonal = np.sqrt(np.diag(result))
    error = _turned_error(error * size, rotation)
    error = np.maximum(error, LEAST_ERROR * np.outer(diagonal, diagonal))
    return AddedMass(
        result, error, solid.frame.outward(center),
        (len(panels.coarse), len(panels.fine)),
        np.array([_symmetric(rotate_matrix6(level * size, rotation)) for level in levels]),
        float(ratios[-1]), time.monotonic() - began,
        solid.frame.outward(_as_triangles(panels.fine)),
    )  # fmt: skip


def _in_frame(images: list[Image], solid: Solid) -> list[Image]:
    """Return images given in mesh axes in the body's own frame."""
    frame = solid.frame
    inner = []
    for image in images:
        turn = frame.rotation.T @ image.turn @ frame.rotation
        inner.append(
            Image(turn, frame.inward(image.turn @ frame.origin + image.shift), image.sign)
        )
    return inner


def _as_triangles(panels: Array) -> Array:
    """Return panels as triangles, four-cornered ones as two."""
    triangles: Array = np.concatenate([
        panels[:, [0, 1, 2]], panels[~three_cornered(panels)][:, [0, 2, 3]],
    ])  # fmt: skip
    return triangles


def _scale(length: float) -> Array:
    """Return the units of a 6x6 matrix per density: length^3, length^4, length^5."""
    arm = np.array([1.0, 1.0, 1.0, length, length, length])
    scale: Array = length**3 * np.outer(arm, arm)
    return scale


def _symmetric(matrix: Array) -> Array:
    result: Array = 0.5 * (matrix + matrix.T)
    return result


def _definite(matrix: Array) -> Array:
    """Return a symmetric matrix with no eigenvalue below a billionth of the largest."""
    values, vectors = np.linalg.eigh(matrix)
    result: Array = (vectors * np.maximum(values, _LOWEST * values[-1])) @ vectors.T
    return result


def _turned_error(error: Array, rotation: Array) -> Array:
    """Return the errors of a turned matrix as if each entry's were independent."""
    both = np.kron(np.eye(2), rotation**2)
    result: Array = np.sqrt(both @ error**2 @ both.T)
    return result
