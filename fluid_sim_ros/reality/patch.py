# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The result of a fit as files: values with their sources, and a model that has them."""

from collections.abc import Sequence
from pathlib import Path

from fluid_sim_ros.errors import printable
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.reality.fit import Fitted
from fluid_sim_ros.reality.parameters import edit_of
from fluid_sim_ros.scene import Scene


def write_patch(found: Fitted, logs: Sequence[str], path: Path) -> Path:
    """
    Write values as YAML, each with its standard error and source.

    Parameters
    ----------
    found
        What a fit returned.
    logs
        That it was fitted to.
    path
        File to write.

    Returns
    -------
    Path
        The file.

    """
    lines = [f'# {line}' for line in (_source(found, logs), *map(printable, found.lines))]
    lines.append('parameters:')
    lines += [f'  {line}' for line in _values(found)]
    with new_file(path) as file:
        file.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return path


def write_model(scene: Scene, found: Fitted, logs: Sequence[str], path: Path) -> Path:
    """
    Write a copy of a scene's model with the fitted values, in one MJCF file.

    Parameters
    ----------
    scene
        Whose model it is.
    found
        What a fit returned.
    logs
        That it was fitted to.
    path
        File to write.

    Returns
    -------
    Path
        The file.

    """
    spec = scene.read_model()
    edit_of(found.parameters, found.values)(spec)
    spec.compile()
    text = spec.to_xml()
    head, _, rest = text.partition('\n')
    # a comment must not hold two hyphens
    notes = [line.replace('--', '- -') for line in (_source(found, logs), *_values(found))]
    comment = '\n'.join(f'       {line}' for line in notes)
    with new_file(path) as file:
        file.write_text(f'{head}\n  <!--\n{comment}\n  -->\n{rest}', encoding='utf-8')
    return path


def _source(found: Fitted, logs: Sequence[str]) -> str:
    names = ', '.join(printable(Path(log).name) for log in logs)
    return (
        f'fitted by fluid_sim fit to {names}: {found.windows} windows, weighted residual '
        f'{found.rms[0]:.3g} before, {found.rms[1]:.3g} after'
    )


def _values(found: Fitted) -> list[str]:
    return [
        f'{p.name}: {v:.9g}  # [{p.unit}] +- {e:.2g} (before {p.value:.6g})'
        for p, v, e in zip(found.parameters, found.values, found.errors, strict=True)
    ]
