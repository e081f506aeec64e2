# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``run.json`` of a log: what it must hold, checked before anything is done with it."""

import json
from typing import Any, NoReturn

from pydantic import ConfigDict, TypeAdapter, ValidationError, field_validator

from fluid_sim_ros.errors import listed, printable
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.grid_files import check_packed
from fluid_sim_ros.schema.base import Positive, Strict, Vector, validated
from fluid_sim_ros.schema.limits import check_limit
from fluid_sim_ros.schema.ros_names import is_topic_name
from fluid_sim_ros.schema.scene import SceneFile

#: Version of the layout of the attachments.
FORMAT = 1
#: Turns every field of a scene into JSON and back.
SCENE = TypeAdapter(Scene)
#: Fields of a scene that stand beside it in a log: the model is an attachment.
BESIDE = {'model_path', 'mjcf', 'assets', 'fleet'}
_NAMED_VERSIONS = ('fluid_sim_ros', 'mujoco', 'machine')


class Streams(Strict):
    """Wind and current at the begin [m/s], and whether they act."""

    wind: Vector
    current: Vector
    enabled: bool


class RunFile(Strict):
    """A recorded run; keys of later releases are passed over."""

    model_config = ConfigDict(extra='ignore', frozen=True)

    format: int
    versions: dict[str, str | None]
    scene: dict[str, Any]
    seed: int
    timestep: Positive
    integrator: str
    fluid: str | None
    namespace: str
    topics: dict[str, str]
    settings: dict[str, Any]
    streams: Streams

    @field_validator('format')
    @classmethod
    def _is_ours(cls, value: int) -> int:
        if value != FORMAT:
            raise ValueError(f'the log has format {value}, this release reads {FORMAT}')
        return value

    @field_validator('versions')
    @classmethod
    def _names_versions(cls, value: dict[str, str | None]) -> dict[str, str | None]:
        if missing := [name for name in _NAMED_VERSIONS if not value.get(name)]:
            raise ValueError(f'lacks {listed(missing)}')
        return value

    @field_validator('namespace')
    @classmethod
    def _is_namespace(cls, value: str) -> str:
        if value.strip('/') and not is_topic_name(value.rstrip('/')):
            raise ValueError('is no namespace of ROS')
        return value

    @field_validator('topics')
    @classmethod
    def _are_names(cls, value: dict[str, str]) -> dict[str, str]:
        for name in value:
            if not is_topic_name(name):
                raise ValueError(f"'{printable(name)}' is no name of ROS")
        return value

    @field_validator('scene')
    @classmethod
    def _names_a_model(cls, value: dict[str, Any]) -> dict[str, Any]:
        for key in ('name', 'model_path'):
            if not isinstance(value.get(key), str):
                raise ValueError(f"key '{key}': must be a text")
        return value


def read_run(content: bytes) -> dict[str, Any]:
    """
    Return what ``run.json`` states, checked.

    Parameters
    ----------
    content
        JSON.

    Returns
    -------
    dict
        Key by key as ``RunFile`` has it.

    Raises
    ------
    FluidSimError
        For the first fault: key, value and what is allowed.

    """
    found = read_json(content, 'run.json')
    if not isinstance(found, dict):
        raise LogError('run.json: must be a mapping')
    return validated(RunFile, found, where='run.json: ').model_dump()


def read_scene(stated: dict[str, Any]) -> dict[str, Any]:
    """
    Return the fields of a recorded scene, but for its model.

    Parameters
    ----------
    stated
        What ``run.json`` says of it.

    Returns
    -------
    dict
        Fields of a ``Scene``.

    Raises
    ------
    FluidSimError
        For the first fault: key, value and what is allowed.

    """
    of_file = {key: stated[key] for key in SceneFile.model_fields if stated.get(key) is not None}
    validated(SceneFile, of_file | {'model': 'attached'}, where='run.json: scene: ')
    fields = {key: value for key, value in stated.items() if key not in BESIDE}
    try:
        scene: Scene = SCENE.validate_python({**fields, 'model_path': ''})
    except ValidationError as error:
        fault = error.errors(include_url=False, include_input=False)[0]
        place = printable('.'.join(map(str, fault['loc'])))
        raise LogError(f"run.json: scene: key '{place}': {printable(fault['msg'])}") from None
    for model in (*scene.wind, *scene.current):
        if (packed := model.packed_grid()) is not None:
            check_packed(packed)
    return {key: getattr(scene, key) for key in scene.__dataclass_fields__ if key not in BESIDE}


def read_json(content: bytes, what: str) -> Any:
    """
    Return the value of JSON text: no NaN, within ``log_values``.

    Parameters
    ----------
    content
        UTF-8.
    what
        Beginning of an error.

    Returns
    -------
    object
        The value.

    Raises
    ------
    LogError
        If it is none.
    LimitError
        If it holds too many values.

    """
    count = sum(content.count(mark) for mark in (b',', b'[', b'{'))
    check_limit('log_values', count, what)
    try:
        return json.loads(content.decode(), parse_constant=_refuse)
    except RecursionError:
        raise LogError(f'{what}: its values are nested too deeply') from None
    except ValueError as error:
        raise LogError(f'{what}: no JSON: {printable(str(error))}') from None


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f'{constant} is no number')
