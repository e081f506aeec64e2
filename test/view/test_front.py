# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Who reaches the page: this machine's own browser, or one that knows the token."""

import socket
import time
import urllib.error
import urllib.request

import pytest

pytest.importorskip('viser', reason='the extra view is not installed')

import viser
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.view.web.front import Server, bound_socket


@pytest.fixture(scope='module')
def page():
    server = Server('127.0.0.1', 0, 'test')
    yield server
    server.close()


@pytest.fixture(scope='module')
def open_page():
    server = Server('0.0.0.0', 0, 'test')
    yield server
    server.close()


def get(url, **headers):
    request = urllib.request.Request(url, headers=headers)
    try:
        with urllib.request.urlopen(request, timeout=10) as answer:
            return answer.status, dict(answer.headers), answer.read()
    except urllib.error.HTTPError as error:
        return error.code, {}, error.read()


def refused(address, **options):
    with pytest.raises(InvalidStatus) as error, connect(address, **options):
        pass
    return error.value.response.body.decode()


def say_nothing_wrong(address, **options):
    """Connect, and wait until the server closes."""
    with connect(address, **options) as connection, pytest.raises(ConnectionClosed):
        connection.recv(timeout=10)


def port_of(server):
    return int(server.url.split(':')[2].split('/')[0])


def test_the_page_is_served_to_this_machine(page):
    status, headers, body = get(page.url)
    assert status == 200 and b'<html' in body
    assert "frame-ancestors 'none'" in headers['Content-Security-Policy']
    assert 'Set-Cookie' not in headers


@pytest.mark.parametrize('host', ['evil.example', 'evil.example:{port}', '127.0.0.1', '[::1'])
def test_another_name_for_this_machine_is_refused(page, host):
    status, _, body = get(page.url, Host=host.format(port=port_of(page)))
    assert status == 403 and b'not the address of this page' in body


@pytest.mark.parametrize('origin', ['http://evil.example', 'null', 'http://127.0.0.1', 'file://'])
def test_another_sites_page_cannot_connect(page, origin):
    body = refused(page.url.replace('http', 'ws', 1), origin=origin)
    assert 'is not this page' in body


def test_the_address_takes_nothing_but_a_token(page):
    # viser's page would connect to any server that its address names
    status, _, body = get(f'{page.url}?websocket=ws://evil.example')
    assert status == 403 and b'nothing else' in body


@pytest.mark.parametrize('path', ['../front.py', '%2e%2e/%2e%2e/_viser.py', 'etc/passwd', 'a/..'])
def test_no_other_file_is_served(page, path):
    status, _, _ = get(page.url + path)
    assert status == 404


def test_beyond_this_machine_a_token_is_needed(open_page):
    bare = f'http://127.0.0.1:{port_of(open_page)}/'
    token = open_page.url.partition('?token=')[2]
    assert len(token) >= 32
    assert get(bare)[0] == 403
    assert get(f'{bare}?token={token[:-1]}')[0] == 403
    status, headers, _ = get(f'{bare}?token={token}')
    assert status == 200
    cookie = headers['Set-Cookie']
    assert 'HttpOnly' in cookie and 'SameSite=Strict' in cookie

    socket = bare.replace('http', 'ws', 1)
    assert 'token' in refused(socket)
    # what the browser then sends
    with connect(
        socket, additional_headers={'Cookie': cookie.partition(';')[0]}, subprotocols=['viser-v0']
    ):
        pass


def test_no_tunnel_can_be_asked_for(page):
    assert page.viser.request_share_url() is None
    assert page.viser._share_tunnel is None


def test_a_host_that_is_not_here_is_one_line():
    with pytest.raises(ConfigError, match='--host'):
        bound_socket('no-such-host.invalid', 0)
    with pytest.raises(ConfigError, match='cannot listen'):
        bound_socket('192.0.2.1', 0)


def test_a_flood_of_connections_that_speak_another_protocol_is_a_line_a_second(capfd):
    lines, seen = [], []
    said = ThrottledLog(lines.append)

    def report(key, line):
        seen.append(key)
        said(key, line)

    server = Server('127.0.0.1', 0, 'test', report=report)
    try:
        address = server.url.replace('http', 'ws', 1)
        for _ in range(20):
            say_nothing_wrong(address, subprotocols=['viser-v0'])
        for _ in range(5):  # no request at all
            with socket.create_connection(('127.0.0.1', port_of(server))) as connection:
                connection.sendall(b'\x00\xff\r\n\r\n')
                connection.recv(1000)
        version = f'viser-v{viser.__version__}'
        with connect(address, subprotocols=[version]) as connection:
            connection.send(b'\xc1no message of viser')
            with pytest.raises(ConnectionClosed):
                while True:
                    connection.recv(timeout=10)
        end = time.monotonic() + 20
        while 'failure' not in seen and time.monotonic() < end:
            time.sleep(0.01)  # it is told after the connection is closed
    finally:
        server.close()
    assert seen.count('protocol') == 20 and seen.count('failure') >= 1
    assert len(lines) < len(seen)
    assert 'a connection was rejected: it speaks viser-v0, not viser-v' in lines[0]
    assert all(line.isprintable() for line in lines)
    told = capfd.readouterr()
    assert 'viser' not in told.out and 'Traceback' not in told.err
