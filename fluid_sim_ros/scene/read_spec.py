# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads a model as a spec that can be changed before it is compiled."""

from collections.abc import Mapping
from pathlib import Path

import mujoco

from fluid_sim_ros.errors import ModelError
from fluid_sim_ros.plugins.attached import crashing_replicate, dropped_plugin
from fluid_sim_ros.scene.named_files import check_named_files
from fluid_sim_ros.schema.data_file import open_data


def read_spec(path: Path, mjcf: str, assets: Mapping[str, bytes]) -> mujoco.MjSpec:
    """
    Return a model as it is written.

    Parameters
    ----------
    path
        Of its file.
    mjcf, assets
        Its text in place of the file, or '', and the content of the files that the text names.

    Raises
    ------
    ModelError
        For what MuJoCo cannot read, or would crash on: one line that names the file.

    """
    text = mjcf
    if not mjcf:
        try:
            with open_data(path) as file:
                text = file.read().decode('utf-8', 'replace')
        except OSError as error:
            raise ModelError(f'{path}: {error.strerror}') from None
    if crash := crashing_replicate(text):
        raise ModelError(f'{path}: {crash}')
    if not assets:
        check_named_files(path, text)
    try:
        if mjcf:
            # some are read with the text (models, flexes), the others when it is compiled
            files = dict(assets)
            spec = mujoco.MjSpec.from_string(mjcf, files, files)
        else:
            spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise ModelError(f'{path}: {" ".join(str(error).split())}') from None
    if lost := dropped_plugin(spec):
        raise ModelError(f'{path}: {lost}')
    return spec
