"""Who may talk to the server, and what it answers over HTTP."""

from __future__ import annotations

import gzip
import http.client
import socket
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from tests.patience import stretched
from tests.studio.page import Page
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.studio import Server, Studio
from gazelle.studio.security import CONTENT_SECURITY_POLICY, Guard, Secret

_TOKEN = "a-token"


class Answer(NamedTuple):
    """An HTTP response."""

    status: int
    headers: Any
    body: bytes


def get(
    server: Server, path: str, method: str = "GET", *, token: bool = True, **headers: str
) -> Answer:
    """Send one request with these headers and no others but the page's token."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=stretched())
    connection.putrequest(method, path, skip_host="Host" in headers, skip_accept_encoding=True)
    if "Cookie" not in headers and "token=" not in path and token:
        headers["Cookie"] = f"gazelle_studio_{server.port}={server.token}"
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return Answer(answer.status, answer.headers, body)


def test_the_page_comes_with_its_policy(server: Server) -> None:
    answer = get(server, "/")
    assert answer.status == 200
    assert answer.headers["Content-Type"] == "text/html; charset=utf-8"
    assert answer.headers["Content-Security-Policy"] == CONTENT_SECURITY_POLICY
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert b"<html" in answer.body
    assert "frame-ancestors 'none'" in CONTENT_SECURITY_POLICY


def test_unchanged_files_are_not_sent_again(server: Server) -> None:
    tag = get(server, "/").headers["ETag"]
    again = get(server, "/", If_None_Match=tag)
    assert (again.status, again.body) == (304, b"")


def test_long_files_are_packed_for_those_who_take_it(
    server: Server, monkeypatch: Any, tmp_path: Any
) -> None:
    from gazelle.studio import http_answers

    monkeypatch.setattr(http_answers, "_PAGE", tmp_path)
    (tmp_path / "app.js").write_text("let a = 1;\n" * 1000)
    answer = get(server, "/app.js", Accept_Encoding="gzip")
    assert answer.headers["Content-Encoding"] == "gzip"
    assert gzip.decompress(answer.body) == get(server, "/app.js").body
    assert answer.headers["Content-Type"] == "text/javascript; charset=utf-8"


def test_head_has_no_body_and_other_methods_are_refused(server: Server) -> None:
    head = get(server, "/", "HEAD")
    assert (head.status, head.body) == (200, b"")
    assert int(head.headers["Content-Length"]) > 0
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        assert get(server, "/", method).status == 405


@pytest.mark.parametrize(
    "path",
    [
        "/nothing.js",
        "/../server.py",
        "/%2e%2e/server.py",
        "/assets/..%2f..%2f..%2fsecurity.py",
        "/..%5cserver.py",
        "//etc/passwd",
        "/%00",
        "/mesh/../../etc/passwd",
        "/mesh/nokey",
        "/texture/nokey",
        "/file/notoken",
        "/file/",
        "/" + "a" * 5000,
    ],
)
def test_paths_outside_are_not_found(server: Server, path: str) -> None:
    answer = get(server, path)
    assert answer.status == 404
    assert answer.headers["Content-Security-Policy"] == CONTENT_SECURITY_POLICY


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1", "127.0.0.1:1", "[::1", "", "a b"]
)
def test_a_foreign_host_is_refused(server: Server, host: str) -> None:
    answer = get(server, "/", Host=host.format(port=server.port))
    assert answer.status == 403
    assert b"only to its own address" in answer.body


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"])
def test_names_of_this_machine_are_its_own(server: Server, host: str) -> None:
    assert get(server, "/", Host=f"{host}:{server.port}").status == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1", "file://"])
def test_a_foreign_origin_is_refused(server: Server, origin: str) -> None:
    assert get(server, "/", Origin=origin).status == 403
    with pytest.raises(InvalidStatus) as caught:
        Page(server.port, Origin=origin)
    assert caught.value.response.status_code == 403


def test_its_own_page_may_connect(server: Server) -> None:
    page = Page(server.port, Origin=f"http://127.0.0.1:{server.port}")
    assert page.hello["op"] == "hello"
    page.close()


def test_the_socket_path_without_a_websocket(server: Server) -> None:
    assert get(server, "/ws").status == 426


def test_rubbish_on_the_port_does_no_harm(server: Server) -> None:
    for data in (b"\x16\x03\x01\x02\x00", b"GET\r\n\r\n", b"GET / HTTP/9\r\n\r\n", b"\0" * 9000):
        with socket.create_connection(("127.0.0.1", server.port), stretched()) as raw:
            raw.sendall(data)
            raw.shutdown(socket.SHUT_WR)
            while raw.recv(4096):
                pass
    assert get(server, "/").status == 200


@pytest.mark.parametrize("host", ["127.0.0.1", "0.0.0.0"])
def test_every_address_needs_the_token(graph: Graph, host: str) -> None:
    """Another user of the machine reaches 127.0.0.1, too."""
    with Server(Studio(graph), host=host, port=0) as server:
        assert server.url == f"http://{host}:{server.port}/?token={server.token}"
        assert get(server, "/", token=False).status == 403
        assert get(server, "/ws", token=False).status == 403
        assert get(server, "/?token=", token=False).status == 403
        assert get(server, "/?token=wrong").status == 403
        first = get(server, f"/?token={server.token}")
        assert first.status == 200
        cookie = first.headers["Set-Cookie"]
        assert cookie == (
            f"gazelle_studio_{server.port}={server.token}; HttpOnly; SameSite=Strict; Path=/"
        )
        assert get(server, "/", Cookie=cookie.split(";")[0]).status == 200
        assert get(server, "/", Cookie=f"gazelle_studio_{server.port}=no").status == 403
        assert get(server, "/", Cookie="=;;=,[]").status == 403
        with pytest.raises(InvalidStatus):
            connect(f"ws://127.0.0.1:{server.port}/ws")
        page = Page(server.port, Cookie=cookie.split(";")[0])
        assert page.hello["op"] == "hello"
        page.close()


def test_token_on_this_machine_is_the_same_each_time_and_another_one_for_others(
    graph: Graph,
) -> None:
    tokens = []
    for host in ("127.0.0.1", "127.0.0.1", "0.0.0.0", "0.0.0.0"):
        with Server(Studio(graph), host=host, port=0) as server:
            tokens.append(server.token)
    assert tokens[0] == tokens[1]
    assert len({*tokens}) == 3


def test_secret_that_cannot_be_read_is_told_and_nothing_is_served(
    graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "secret").write_text("nonsense")
    (tmp_path / "secret").chmod(0o600)
    monkeypatch.setenv("GAZELLE_SECRET_FILE", str(tmp_path / "secret"))
    studio = Studio(graph)
    with pytest.raises(GazelleError, match=r"is no secret, one line of name:password\n  fix: "):
        Server(studio, port=0)
    studio.close()


def test_addresses_are_taken_for_own_only_where_all_were_bound() -> None:
    everywhere = Guard("0.0.0.0", 80, _TOKEN)
    one = Guard("192.168.0.7", 80, _TOKEN)
    path = f"/?token={_TOKEN}"
    headers = {"192.168.0.7": True, "10.1.2.3": True, "evil.example": False}
    for host, mine in headers.items():
        assert (not everywhere.refusal(path, _headers(host))) is mine
    assert not one.refusal(path, _headers("192.168.0.7"))
    assert one.refusal(path, _headers("10.1.2.3"))


def test_a_port_that_is_taken_is_told(server: Server, graph: Graph) -> None:
    studio = Studio(graph)
    with pytest.raises(GazelleError, match=r"cannot listen on 127\.0\.0\.1, port") as caught:
        Server(studio, port=server.port)
    assert "fix: choose another one with --port" in str(caught.value)
    studio.close()


def _headers(host: str) -> Any:
    from websockets.datastructures import Headers

    return Headers({"Host": host})


def test_logs_and_tracebacks_show_no_secret() -> None:
    secret = Secret(Path("page"), "me", "4711")
    assert repr(secret) == f"Secret(path={Path('page')!r}, user='me', password='***')"
    assert repr(Guard("127.0.0.1", 80, "4711")) == "Guard(bound='127.0.0.1', port=80, token='***')"
