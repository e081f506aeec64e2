# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The models of a fleet in a log: each gathered once, however many vehicles have it."""

import posixpath
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from fluid_sim_ros.loop.recorder_port import RecorderOptions
from fluid_sim_ros.recording.model.files import Gathered, gather
from fluid_sim_ros.recording.model.sources import AttachedFiles, files_of
from fluid_sim_ros.scene.fleet.members import Fleet, Member
from fluid_sim_ros.schema.base import Name, Strict, validated
from fluid_sim_ros.schema.fleet import FleetVehicle
from fluid_sim_ros.schema.limits import check_limit


class FleetOfLog(Strict):
    """A fleet in ``run.json``; the models of its members are paths of attachments."""

    members: dict[Name, FleetVehicle]
    taken_out: list[str]


def fleet_of_log(
    fleet: Fleet, options: RecorderOptions
) -> tuple[dict[str, Any], dict[str, bytes]]:
    """
    Return a fleet as a log states it.

    Parameters
    ----------
    fleet
        The vehicles.
    options
        Of the recording, for folders that files may come from.

    Returns
    -------
    stated, files
        What ``run.json`` says, and the files of all models by their path in the log.

    Raises
    ------
    ConfigError
        As ``files_of``.

    """
    paths: dict[tuple[Path, str], str] = {}
    files: dict[str, bytes] = {}
    members = {}
    for name, member in fleet.members.items():
        key = (member.model_path, member.mjcf)
        if key not in paths:
            folder = f'fleet{len(paths)}'
            path, own = files_of(
                member.model_path, member.mjcf, member.assets, options.allow_assets_from
            )
            files |= {f'{folder}/{place}': content for place, content in own.items()}
            paths[key] = f'{folder}/{path}'
        stated = FleetVehicle(
            model=paths[key], vehicle=member.kind, position=list(member.position), yaw=member.yaw,
            keyframe=member.keyframe, autopilot=member.autopilot,
        )  # fmt: skip
        members[name] = stated.model_dump(mode='json')
    return {'members': members, 'taken_out': list(fleet.taken_out)}, files


def read_fleet(stated: Any) -> Fleet:
    """
    Return the fleet that ``run.json`` states; the models of its members are not read yet.

    Parameters
    ----------
    stated
        Of the log.

    Raises
    ------
    ConfigError
        For the first fault: key, value and what is allowed.

    """
    found = validated(FleetOfLog, stated, where='run.json: scene: fleet: ')
    check_limit('fleet_vehicles', len(found.members), 'run.json: scene: fleet: vehicles')
    members = {
        name: Member(
            Path(posixpath.normpath(vehicle.model)), tuple(vehicle.position), vehicle.yaw,
            vehicle.keyframe, vehicle.autopilot,
            vehicle.vehicle if isinstance(vehicle.vehicle, str) else '',
        )
        for name, vehicle in found.members.items()
    }  # fmt: skip
    return Fleet(members, tuple(found.taken_out))


def gathered_models(fleet: Fleet, files: Mapping[str, bytes]) -> list[Gathered]:
    """
    Return the model of each member, made of the attachments of a log alone.

    Parameters
    ----------
    fleet
        Of the log.
    files
        Its attachments by path.

    Raises
    ------
    MjcfError
        For a file that is not attached, or no XML.

    """
    read = AttachedFiles(files).read
    paths = [member.model_path.as_posix() for member in fleet.members.values()]
    found = {path: gather(path, read) for path in dict.fromkeys(paths)}
    return [found[path] for path in paths]


def of_log(fleet: Fleet, models: list[Gathered]) -> Fleet:
    """
    Return a fleet whose members have their models as text.

    Parameters
    ----------
    fleet
        Of the log.
    models
        Of its members, in their order.

    """
    members = {
        name: replace(member, mjcf=model.text, assets=model.assets)
        for (name, member), model in zip(fleet.members.items(), models, strict=True)
    }
    return replace(fleet, members=members)
