# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is written into the pictures of a film: time and speed, and a bar that shows the scale."""

import math
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array

#: A bar is not longer than this share of the picture's width.
_LONGEST = 0.25
_MARGIN, _HEIGHT = 0.02, 0.045  # shares of the picture's height
_INK, _SHADE = (255, 255, 255), (0, 0, 0)


def captioned(picture: Any, words: str, pixels_per_metre: float) -> Any:
    """
    Return a picture with a line of words and a scale bar.

    Parameters
    ----------
    picture
        8-bit RGB, shape (height, width, 3).
    words
        Are written at the upper left.
    pixels_per_metre
        At the distance of what is followed; 0: no bar.

    Returns
    -------
    Picture
        A new one.

    """
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    width, height = image.size
    margin, size = max(4, int(_MARGIN * height)), max(9, int(_HEIGHT * height))
    font = ImageFont.load_default(size)
    outline = max(1, size // 12)
    style: dict[str, Any] = {
        'font': font, 'fill': _INK, 'stroke_fill': _SHADE, 'stroke_width': outline,
    }  # fmt: skip
    draw.text((margin, margin), words, **style)
    if pixels_per_metre > 0.0:
        metres = round_length(_LONGEST * width / pixels_per_metre)
        length, y = metres * pixels_per_metre, height - 2 * margin
        box = (margin, y - outline, margin + length, y + outline)
        draw.rectangle(box, fill=_INK, outline=_SHADE)
        draw.text((margin, y - size - 2 * outline - 2), f'{metres:g} m', **style)
    return np.asarray(image)


def round_length(most: float) -> float:
    """
    Return the largest of 1, 2, 5, 10, ... and their tenths that is not above a length.

    Parameters
    ----------
    most
        Above 0.

    """
    power = 10.0 ** math.floor(math.log10(most))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= most * (1 + 1e-9))


def pixels_per_metre(
    model: mujoco.MjModel, scene: mujoco.MjvScene, place: Array, height: int
) -> float:
    """
    Return the scale of a picture at a place.

    Parameters
    ----------
    model, scene
        What is drawn.
    place
        World [m], shape (3,).
    height
        Of the picture [pixels].

    Returns
    -------
    float
        [pixels/m]; 0 behind the camera.

    """
    camera = scene.camera[0]
    ahead = float(np.dot(np.asarray(place) - camera.pos, camera.forward))
    half = float(camera.frustum_top) / float(camera.frustum_near)
    return height / (2.0 * half * ahead) if ahead > 0.0 and half > 0.0 else 0.0
