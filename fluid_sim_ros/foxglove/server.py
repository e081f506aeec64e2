# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The WebSocket server of the Foxglove SDK: parameters and services of a run beside its topics."""

import json
from collections.abc import Callable
from typing import Any

import foxglove
from foxglove import Context, Schema
from foxglove.websocket import (
    Capability,
    Client,
    MessageSchema,
    Parameter,
    ServerListener,
    Service,
    ServiceRequest,
    ServiceSchema,
)

from fluid_sim_ros.errors import ConfigError, FluidSimError, listed
from fluid_sim_ros.loop.foxglove_port import LiveControl

#: This machine alone: the protocol knows no password.
_HOST = '127.0.0.1'
_SERVICES = {'reset': False, 'step': False, 'pause': True}  # whether it takes a truth value
#: Longer requests are none [bytes].
_LONGEST = 1000


class LiveServer:
    """
    Serves the channels of a context.

    Parameters
    ----------
    name
        Of what is shown.
    port
        To listen on; 0: any that is free.
    context
        With the channels.
    control
        What a viewer may do.

    Attributes
    ----------
    port
        That it listens on.

    Raises
    ------
    ConfigError
        If the port is in use.

    """

    def __init__(self, name: str, port: int, context: Context, control: LiveControl) -> None:
        try:
            self._server = foxglove.start_server(
                name=f'fluid_sim: {name}', host=_HOST, port=port, context=context,
                capabilities=[Capability.Parameters, Capability.Services, Capability.Time],
                server_listener=_Parameters(control), supported_encodings=['json'],
                services=[_service(key, takes, control) for key, takes in _SERVICES.items()],
            )  # fmt: skip
        except (OSError, RuntimeError) as error:
            raise ConfigError(
                f'foxglove: port {port} on {_HOST} cannot be used: {error}; choose another'
            ) from None
        self.port = int(self._server.port)

    def tell_time(self, stamp_ns: int) -> None:
        """
        Tell viewers the simulated time.

        Parameters
        ----------
        stamp_ns
            [ns].

        """
        self._server.broadcast_time(stamp_ns)

    def begin_anew(self) -> None:
        """Have viewers forget what they have seen: time was set back."""
        self._server.clear_session()

    def close(self) -> None:
        """Close every connection."""
        self._server.stop()


class _Parameters(ServerListener):  # type: ignore[misc]  # the SDK is an extra
    """Answers viewers that read and set parameters."""

    def __init__(self, control: LiveControl) -> None:
        self._control = control

    def on_get_parameters(
        self, client: Client, param_names: list[str], request_id: str | None = None
    ) -> list[Parameter]:
        values = self._control.parameters()
        names = param_names or list(values)
        return [Parameter(name, value=values[name]) for name in names if name in values]

    def on_set_parameters(
        self, client: Client, parameters: list[Parameter], request_id: str | None = None
    ) -> list[Parameter]:
        changes = {parameter.name: parameter.get_value() for parameter in parameters}
        known = {name: changes[name] for name in changes if name in self._control.changeable}
        try:
            if known:
                self._control.change(known)
        except (FluidSimError, TypeError, ValueError):
            pass  # what is read back below is what holds
        values = self._control.parameters()
        return [Parameter(name, value=values[name]) for name in changes if name in values]


def _service(name: str, takes_truth: bool, control: LiveControl) -> Service:
    kind = 'SetBool' if takes_truth else 'Trigger'
    request: dict[str, Any] = {'type': 'object', 'properties': {}}
    if takes_truth:
        request['properties'] = {'data': {'type': 'boolean'}}
    response = {
        'type': 'object',
        'properties': {'success': {'type': 'boolean'}, 'message': {'type': 'string'}},
    }
    schema = ServiceSchema(
        f'std_srvs/srv/{kind}',
        request=_message(f'std_srvs/srv/{kind}_Request', request),
        response=_message(f'std_srvs/srv/{kind}_Response', response),
    )
    return Service(
        f'/fluid_sim/{name}', schema=schema, handler=_handler(name, takes_truth, control)
    )


def _message(name: str, schema: dict[str, Any]) -> MessageSchema:
    text = json.dumps(schema).encode()
    return MessageSchema(
        encoding='json', schema=Schema(name=name, encoding='jsonschema', data=text)
    )


def _handler(
    name: str, takes_truth: bool, control: LiveControl
) -> Callable[[ServiceRequest], bytes]:
    def handle(request: ServiceRequest) -> bytes:
        try:
            message = control.act(name, takes_truth and _truth(request.payload))
        except FluidSimError as error:
            return json.dumps({'success': False, 'message': str(error)}).encode()
        return json.dumps({'success': True, 'message': message}).encode()

    return handle


def _truth(payload: bytes) -> bool:
    try:
        given = json.loads(payload) if len(payload) <= _LONGEST else None
    except ValueError:
        given = None
    if not isinstance(given, dict) or not isinstance(given.get('data'), bool):
        raise ConfigError(f'the request must be {{"data": {listed(["true", "false"])}}}')
    return bool(given['data'])
