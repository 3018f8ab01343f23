"""What strangers may send, and what they get."""

from __future__ import annotations

import contextlib
import socket
import struct
from collections.abc import Iterator
from typing import Any

import pytest
from tests.bridge.ros1.peer import ask, pack_header, post, read_fields

from gazelle.bridge.ros1 import Address, MasterAddress, master_address, own_address
from gazelle.bridge.ros1.addresses import address_of_master
from gazelle.bridge.ros1.tcpros import read_header, write_header
from gazelle.bridge.ros1.tcpros_server import ServerSocket
from gazelle.bridge.ros1.xmlrpc_call import RemoteError, RemoteRefusedError, call
from gazelle.errors import GraphError

HERE = "127.0.0.1"
GOOD = b"<methodCall><methodName>hello</methodName><params></params></methodCall>"
Notices = list[str]


@pytest.fixture
def notices() -> Notices:
    return []


@pytest.fixture
def server_socket(notices: Notices) -> Iterator[ServerSocket]:
    """Answers ``hello``, fails at ``fail``, and sends headers back."""

    def fail() -> Any:
        raise RuntimeError("inside")

    def echo(stream: socket.socket) -> None:
        stream.sendall(write_header(read_header(stream)))

    methods = {"hello": lambda: (1, "", "hi"), "no": lambda: (0, "not so", 0), "fail": fail}
    found = ServerSocket(own_address({}), methods, echo, notices.append)
    yield found
    found.close()


def test_both_protocols_share_a_port(server_socket: ServerSocket) -> None:
    assert ask(server_socket.uri, "hello") == [1, "", "hi"]
    with socket.create_connection((HERE, server_socket.port)) as stream:
        stream.sendall(pack_header({"topic": "/a", "odd": "x=y"}))
        assert read_fields(stream) == {"topic": "/a", "odd": "x=y"}


def test_page_of_another_host_is_refused(server_socket: ServerSocket) -> None:
    assert post(server_socket.uri, GOOD).status == 200
    assert post(server_socket.uri, GOOD, Host=f"evil.example:{server_socket.port}").status == 403
    assert post(server_socket.uri, GOOD, Origin="http://localhost").status == 403


@pytest.mark.parametrize(
    "body",
    [
        b'<!DOCTYPE x [<!ENTITY a "aaaa">]>' + GOOD,
        b"not xml",
        b"<methodCall><methodName>hello</methodName><params><param><value><int>x</int>"
        b"</value></param></params></methodCall>",
        b"",
    ],
)
def test_bad_calls_are_refused(server_socket: ServerSocket, body: bytes) -> None:
    assert post(server_socket.uri, body).status == 400
    assert ask(server_socket.uri, "hello") == [1, "", "hi"]


def test_call_that_claims_too_much_is_refused(server_socket: ServerSocket) -> None:
    with socket.create_connection((HERE, server_socket.port), 10.0) as stream:
        head = f"POST / HTTP/1.1\r\nHost: {HERE}:1\r\nContent-Length: 99999999999\r\n\r\n"
        stream.sendall(head.encode())
        assert stream.recv(64).startswith(b"HTTP/1.1 413 ")


def test_failure_inside_reaches_the_caller_and_the_user(
    server_socket: ServerSocket, notices: Notices
) -> None:
    assert ask(server_socket.uri, "fail") == [-1, "inside", 0]
    assert notices[0].startswith("fail failed: inside\nTraceback")


def test_failures_of_a_server_are_told_apart(server_socket: ServerSocket) -> None:
    assert call(server_socket.uri, "hello") == "hi"
    with pytest.raises(RemoteRefusedError, match="not so"):
        call(server_socket.uri, "no")
    with pytest.raises(RemoteError, match='method "what" is not supported'):
        call(server_socket.uri, "what")
    with pytest.raises(RemoteError, match=r"is not http://host:port/"):
        call("ftp://x", "hello")


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (struct.pack("<I", 1 << 31), "a frame of 2147483648 bytes, more than the 1048576"),
        (struct.pack("<II", 4, 99), "not a connection header"),
        (struct.pack("<II", 7, 3) + b"abc", "not a connection header"),
    ],
)
def test_bad_headers_are_told_and_end_the_connection(
    server_socket: ServerSocket, notices: Notices, data: bytes, text: str
) -> None:
    with socket.create_connection((HERE, server_socket.port), 10.0) as stream:
        stream.sendall(data)
        assert stream.recv(1) == b""
    assert text in notices[0]


def test_closing_ends_what_is_open(server_socket: ServerSocket) -> None:
    with socket.create_connection((HERE, server_socket.port), 10.0) as stream:
        server_socket.close()
        with contextlib.suppress(ConnectionResetError):
            assert stream.recv(1) == b""
    with pytest.raises(OSError):
        socket.create_connection((HERE, server_socket.port), 1.0).close()


def test_only_this_machine_is_served_without_the_variables() -> None:
    assert own_address({}) == Address(HERE, HERE, frozenset({"localhost", HERE, "[::1]"}))
    assert own_address({"ROS_IP": "127.0.0.2"}).bind == "127.0.0.2"
    found = own_address({"ROS_HOSTNAME": "localhost", "ROS_IP": "10.255.255.1"})
    assert (found.host, found.is_loopback) == ("localhost", True)
    with pytest.raises(GraphError, match=r"ROS_IP is '203\.0\.113\.7', which is not an address"):
        own_address({"ROS_IP": "203.0.113.7"})


def test_master_is_found_under_the_name_it_is_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(socket, "gethostbyname", {"robot": "127.0.1.1", "lab": "10.1.2.3"}.get)
    own = own_address({})
    found = address_of_master(MasterAddress("robot", 11311), own)
    assert (found.bind, found.host) == ("127.0.1.1", "robot")
    assert {"robot", "127.0.1.1", "localhost"} <= found.names
    assert address_of_master(MasterAddress("localhost", 11311), own).bind == HERE
    with pytest.raises(GraphError, match="the bridge is open to none") as raised:
        address_of_master(MasterAddress("lab", 11311), own)
    assert "[bridge.not-open]" in str(raised.value)
    is_open = Address("0.0.0.0", "lab", own.names)
    assert address_of_master(MasterAddress("lab", 11311), is_open).host == "lab"


def test_place_of_the_master_is_that_of_the_variable() -> None:
    assert master_address({}).uri == "http://127.0.0.1:11311/"
    assert master_address({"ROS_MASTER_URI": "http://robot:11322/"}) == ("robot", 11322)
    assert master_address({"ROS_MASTER_URI": "http://robot:1"}, 11400).uri.endswith(":11400/")
    assert not master_address({"ROS_MASTER_URI": "http://robot.invalid:1"}).is_here
    assert master_address({"ROS_MASTER_URI": "http://localhost:1"}).is_here
    with pytest.raises(GraphError, match=r"ROS_MASTER_URI is 'robot', not http://<host>:<port>"):
        master_address({"ROS_MASTER_URI": "robot"})
