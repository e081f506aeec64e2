# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Planes near a body: walls, the bed and the surface, as mirrors."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array

#: Reflections between two parallel planes that are followed.
_REFLECTIONS = 6


@dataclass(frozen=True)
class Plane:
    """
    A plane that bounds the fluid: ``normal . x = offset``.

    Attributes
    ----------
    name
        What it is called in an error.
    normal
        Unit vector, mesh axes, shape (3,).
    offset
        Along the normal [m].
    free
        A free surface in the limit of infinite frequency (potential 0); otherwise rigid.

    """

    name: str
    normal: Array
    offset: float
    free: bool = False


@dataclass(frozen=True)
class Image:
    """
    A mirror image of the body: ``x' = turn x + shift``, its potential times ``sign``.

    Attributes
    ----------
    turn, shift
        Shapes (3, 3) and (3,).
    sign
        1 or -1.

    """

    turn: Array
    shift: Array
    sign: float

    def of_panels(self, panels: Array) -> Array:
        """
        Return the image of panels, corners again counter-clockwise seen from outside.

        Parameters
        ----------
        panels
            Three-cornered ones with the last corner twice, shape (n, 4, 3).

        Returns
        -------
        Shape (n, 4, 3).

        """
        moved = panels @ self.turn.T + self.shift
        if np.linalg.det(self.turn) > 0:
            return moved
        result: Array = moved[:, [1, 0, 3, 2]]
        three = (panels[:, 2] == panels[:, 3]).all(axis=1)
        result[three] = moved[three][:, [1, 0, 2, 2]]
        return result


def plane_of(name: str, normal: Sequence[float], offset: float) -> Plane:
    """
    Return a rigid plane from a normal of any length.

    Parameters
    ----------
    name
        What it is called in an error.
    normal
        Any length but 0, shape (3,).
    offset
        Along the normal, as if that had the length 1 [m].

    Returns
    -------
    Plane
        With a unit normal.

    Raises
    ------
    ConfigError
        If the normal has no direction, or a number is not finite.

    """
    direction = np.array(normal, dtype=float)
    length = float(np.linalg.norm(direction))
    if not np.isfinite(length) or length == 0:
        raise ConfigError(f'{name}: the normal {" ".join(map(str, normal))} has no direction')
    return Plane(name, direction / length, offset)


def check_clear(planes: list[Plane], vertices: Array) -> None:
    """
    Refuse a plane that the body reaches or crosses.

    Parameters
    ----------
    planes
        That bound the fluid.
    vertices
        Of the body, mesh axes [m], shape (n, 3).

    Raises
    ------
    ConfigError
        With the gap that is missing.

    """
    for plane in planes:
        if not np.isfinite(plane.offset):
            raise ConfigError(f'{plane.name}: {plane.offset:g}; must be a finite number [m]')
        heights = vertices @ plane.normal - plane.offset
        if heights.min() > 0 or heights.max() < 0:
            continue
        inside = min(float(heights.max()), float(-heights.min()))
        raise ConfigError(
            f'{plane.name}: the body reaches {inside:.4g} m through it; put it beyond the body, '
            'or cut the mesh there and close it'
        )


def images_of(planes: list[Plane]) -> list[Image]:
    """
    Return the images of a body between planes.

    Parameters
    ----------
    planes
        None, one, two at right angles, or two parallel ones (then a series of images, cut after
        6 reflections).

    Returns
    -------
    list
        Without the body itself.

    Raises
    ------
    ConfigError
        If there are more planes, or two at another angle.

    """
    if len(planes) > 2:
        raise ConfigError('at most two of surface, bed and wall at a time')
    single = [_reflection(plane) for plane in planes]
    if len(planes) < 2:
        return single
    across = abs(float(planes[0].normal @ planes[1].normal))
    if across < 1e-9:
        return [*single, _after(single[0], single[1])]
    if across < 1 - 1e-9:
        raise ConfigError(
            f'{planes[0].name} and {planes[1].name} must be parallel or at right angles'
        )
    images = []
    for first in (0, 1):
        image = single[first]
        for k in range(_REFLECTIONS):
            images.append(image)
            image = _after(single[(first + k + 1) % 2], image)
    return images


def _reflection(plane: Plane) -> Image:
    turn = np.eye(3) - 2 * np.outer(plane.normal, plane.normal)
    return Image(turn, 2 * plane.offset * plane.normal, -1.0 if plane.free else 1.0)


def _after(outer: Image, inner: Image) -> Image:
    """Return the image of an image."""
    return Image(
        outer.turn @ inner.turn, outer.turn @ inner.shift + outer.shift, outer.sign * inner.sign
    )
