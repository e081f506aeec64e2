# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How many elements a model in a log stands for, before MuJoCo makes them."""

import math

from fluid_sim_ros.recording.model.files import Gathered
from fluid_sim_ros.recording.model.mjcf_text import Element, parse_mjcf
from fluid_sim_ros.schema.limits import check_limit


def check_elements(*models: Gathered) -> None:
    """
    Refuse models of a few lines that stand for more elements than ``model_elements``.

    Parameters
    ----------
    *models
        Gathered, of one scene together; attached models count as often as they are attached.

    Raises
    ------
    LimitError
        If they do.

    """
    known: dict[int, int] = {}
    for model in models:
        if id(model) not in known:
            known[id(model)] = _elements_of(model)
    check_limit(
        'model_elements', sum(known[id(model)] for model in models), 'elements of the model'
    )


def _elements_of(model: Gathered) -> int:
    counts: dict[str, int] = {}
    for name in model.attached.values():  # a model stands behind those that it attaches
        counts[name] = _elements(parse_mjcf(model.assets[name]), counts)
    return _elements(parse_mjcf(model.text.encode()), counts)


def _elements(root: Element, attached: dict[str, int]) -> int:
    """Return how many elements a tree stands for."""
    models = {
        element.get('name'): attached.get(element.get('file', ''), 1)
        for element in root.iter('model')
    }
    own = sum(1 for _ in root.iter())
    count = 0
    waiting = [(root, 1)]
    while waiting:
        element, times = waiting.pop()
        if element.tag == 'replicate':
            times *= _counted(element)
        elif element.tag in ('composite', 'flexcomp'):
            count += times * _counted(element)
        elif element.tag == 'attach':  # without a model: a part of this one
            count += times * models.get(element.get('model'), own)
        count += times
        waiting += [(child, times) for child in element]
    return count


def _counted(element: Element) -> int:
    """Return the product of an element's count; what is no number MuJoCo refuses."""
    try:
        return math.prod(max(1, int(word)) for word in element.get('count', '1').split()[:3])
    except ValueError:
        return 1
