# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The server of the page, with a guard in front.

This is the one file that touches what viser keeps to itself (tested with viser 1.1). viser listens
on the next port when one is taken, looks at neither Host nor Origin, and can open a tunnel to a
public address; here its server gets a socket that is bound already, every request passes a guard,
and the tunnel is shut.
"""

import contextlib
import http
import io
import logging
import os
import secrets
import socket
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import urlsplit

import viser
import websockets.asyncio.server
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.view.web.guard import Guard, is_loopback

#: What the page of this version of viser asks for.
_PROTOCOL = f'viser-v{viser.__version__}'
#: Larger messages than this are taken from no browser [bytes].
_MOST_BYTES = 1 << 20
#: Of a line on a failed connection [characters].
_MOST_WORDS = 300


def bound_socket(host: str, port: int) -> socket.socket:
    """
    Return a socket that listens.

    Parameters
    ----------
    host, port
        Where; port 0: any that is free.

    Returns
    -------
    socket
        Bound.

    Raises
    ------
    ConfigError
        If the port is in use, or the host is no address of this machine.

    """
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        listening = socket.socket(family, kind, protocol)
    except OSError as error:
        raise ConfigError(f"--host '{host}': {error.strerror or error}") from None
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind(address)
        listening.listen()
    except OSError as error:
        listening.close()
        raise ConfigError(
            f'--port {port}: cannot listen on {host}: {error.strerror or error}; '
            'another view may be open: end it, or choose another --port'
        ) from None
    return listening


class Server:
    """
    viser's server behind a guard.

    Parameters
    ----------
    host, port
        Where it listens; port 0: any that is free.
    label
        Of the page.
    on_steer
        Handles the connections of the page's script for keys and gamepads; see ``web.steering``.
    script
        JavaScript that is added to the page.
    report
        Takes (key, line) of a connection that is rejected or fails; floods come here whole.

    Attributes
    ----------
    viser
        The server of the scene and the panels.
    url
        To open, with the token where one is needed.

    Raises
    ------
    ConfigError
        If it cannot listen there.

    """

    def __init__(
        self,
        host: str,
        port: int,
        label: str,
        on_steer: Callable[[Any], Any] | None = None,
        script: str = '',
        report: Callable[[str, str], object] = lambda key, line: None,
    ) -> None:
        self._report = report
        listening = bound_socket(host, port)
        port = listening.getsockname()[1]
        token = '' if is_loopback(host) else secrets.token_urlsafe(24)
        self._guard, self._script = Guard(host, port, token), script
        self._on_steer = on_steer
        shown = socket.gethostname() if host in ('0.0.0.0', '::') else host
        shown = f'[{shown}]' if ':' in shown else shown
        self.url = f'http://{shown}:{port}/' + (f'?token={token}' if token else '')
        with self._guarded(listening), _silence():
            self.viser = viser.ViserServer(host=host, port=port, label=label, verbose=False)
        # the button of the tunnel is not shown, and a request for one is not answered
        self.viser.request_share_url = _no_tunnel
        self.viser.gui.configure_theme(show_logo=False, show_share_button=False)

    def close(self) -> None:
        """Close every connection, and the socket."""
        with _silence():
            self.viser.stop()

    @contextlib.contextmanager
    def _guarded(self, listening: socket.socket) -> Iterator[None]:
        """Have viser's server use our socket and our guard while it starts."""
        serve = websockets.asyncio.server.serve

        def guarded_serve(handler: Any, host: str, port: int, **options: Any) -> Any:
            inner = options.pop('process_request')
            options['max_size'] = _MOST_BYTES
            return serve(
                self._routed(handler), sock=listening, logger=_logger(self._report),
                process_request=lambda connection, request: self._answer(
                    connection, request, inner
                ),
                **options,
            )  # fmt: skip

        override = os.environ.pop('_VISER_PORT_OVERRIDE', None)
        websockets.asyncio.server.serve = guarded_serve
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve
            if override is not None:
                os.environ['_VISER_PORT_OVERRIDE'] = override

    def _routed(self, handler: Callable[[Any], Any]) -> Callable[[Any], Any]:
        async def route(connection: Any) -> None:
            path = urlsplit(connection.request.path).path
            if path == '/steer' and self._on_steer is not None:
                await self._on_steer(connection)
            elif connection.subprotocol != _PROTOCOL:  # viser says it of each, in a line
                spoken = printable(connection.subprotocol or 'no protocol', 40)
                words = f'it speaks {spoken}, not {_PROTOCOL}'
                self._report('protocol', f'a connection was rejected: {words}')
                await connection.close(1002, words)
            else:
                await handler(connection)

        return route

    def _answer(
        self, connection: Any, request: Request, inner: Callable[[Any, Request], Response | None]
    ) -> Response | None:
        if reason := self._guard.refusal(request):
            text = f'fluid_sim view: {reason}\n'.encode()
            headers = Headers({'Content-Type': 'text/plain', 'Content-Length': str(len(text))})
            return Response(http.HTTPStatus.FORBIDDEN, 'Forbidden', headers, text)
        with contextlib.suppress(KeyError):
            del request.headers['Accept-Encoding']  # the script is added to plain text
        response = inner(connection, request)
        if response is not None:
            if self._script and response.headers.get('Content-Type', '').startswith('text/html'):
                end = f'<script>{self._script}</script></body>'.encode()
                response.body = response.body.replace(b'</body>', end)
                del response.headers['Content-Length']
                response.headers['Content-Length'] = str(len(response.body))
            for name, value in self._guard.headers().items():
                response.headers[name] = value
        return response


class _Failures(logging.Handler):
    """Reports what websockets logs of connections that fail, one line without a traceback."""

    def __init__(self, report: Callable[[str, str], object]) -> None:
        super().__init__(logging.WARNING)
        self._report = report

    def emit(self, record: logging.LogRecord) -> None:
        """Report a record."""
        error = record.exc_info[1] if record.exc_info else None
        reason = f' ({type(error).__name__}: {error})' if error else ''
        line = f'a connection failed: {record.getMessage()}{reason}'
        self._report('failure', printable(line, _MOST_WORDS))


def _logger(report: Callable[[str, str], object]) -> logging.Logger:
    """Return the logger of a server's connections."""
    logger = logging.Logger('fluid_sim_ros.view.connections')
    logger.addHandler(_Failures(report))
    return logger


def _no_tunnel(verbose: bool = True) -> None:
    """Open nothing: a view is shown to this machine, or under --host with a token."""


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Keep viser's own lines to itself: the command says where the page is."""
    with contextlib.redirect_stdout(io.StringIO()):
        yield
