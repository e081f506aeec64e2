# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Decides which requests reach the page."""

import hmac
import ipaddress
from urllib.parse import parse_qsl, urlsplit

from websockets.http11 import Request

#: The page and its connection are its own; no other page may frame it or read its address.
_SAFETY = {
    'Content-Security-Policy': (
        "default-src 'self' 'unsafe-inline' 'wasm-unsafe-eval' data: blob:; "
        "connect-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'none'"
    ),
    'X-Content-Type-Options': 'nosniff',
    'Referrer-Policy': 'no-referrer',
    'Cross-Origin-Resource-Policy': 'same-origin',
    'Cache-Control': 'no-store',
}


def is_loopback(host: str) -> bool:
    """
    Return whether a host is this machine alone.

    Parameters
    ----------
    host
        Name or address.

    """
    if host == 'localhost':
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


class Guard:
    """
    Decides which requests reach the page.

    Host must be an address that the server was opened under: another site's name that is made to
    point here (DNS rebinding) is refused. A connection's Origin must be the page itself. Where
    others than this machine can connect, the address of the page holds a token, which the browser
    then keeps as a cookie.

    Parameters
    ----------
    host, port
        Of the server.
    token
        That a browser must know; empty: none.

    """

    def __init__(self, host: str, port: int, token: str) -> None:
        self._port, self._token = port, token
        self._cookie = f'fluid_sim_view_{port}'
        names = {host}
        if is_loopback(host):
            names |= {'localhost', '127.0.0.1', '::1'}
        # every address of this machine: the token is what protects it
        self._any = host in ('0.0.0.0', '::', '')
        self._names = names

    def refusal(self, request: Request) -> str:
        """
        Return why a request is refused, or nothing.

        Parameters
        ----------
        request
            As it came.

        Returns
        -------
        str
            One line; empty: it may pass.

        """
        host = ', '.join(request.headers.get_all('Host'))
        if not self._is_ours(f'//{host}'):
            return f'Host {host!r} is not the address of this page'
        origins = request.headers.get_all('Origin')
        # a program that is no browser sends no Origin; a page of another site always does
        if origins and origins != [f'http://{host}']:
            return f'Origin {origins[0]!r} is not this page'
        query = parse_qsl(urlsplit(request.path).query, keep_blank_values=True)
        if [name for name, _ in query if name != 'token']:
            return 'the address of the page takes token= and nothing else'
        if self._token and not self._knows(request, dict(query)):
            return 'the token is missing or wrong: take the whole address that fluid_sim printed'
        return ''

    def headers(self) -> dict[str, str]:
        """Return the headers that every answer gets."""
        if not self._token:
            return _SAFETY
        kept = f'{self._cookie}={self._token}; HttpOnly; SameSite=Strict; Path=/'
        return _SAFETY | {'Set-Cookie': kept}

    def _is_ours(self, address: str) -> bool:
        try:
            parts = urlsplit(address)
            name, port = parts.hostname or '', parts.port or 80
        except ValueError:
            return False
        return port == self._port and (self._any or name in self._names)

    def _knows(self, request: Request, query: dict[str, str]) -> bool:
        cookies = [
            part.strip().partition('=')
            for header in request.headers.get_all('Cookie')
            for part in header.split(';')
        ]
        given = [value for name, _, value in cookies if name == self._cookie]
        given.append(query.get('token', ''))
        token = self._token.encode()
        return any(hmac.compare_digest(value.encode(), token) for value in given)
