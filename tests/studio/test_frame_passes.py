"""Who may show the page in a frame."""

from __future__ import annotations

from typing import Any

import pytest
from tests.patience import eventually
from tests.studio.page import Page
from websockets.datastructures import Headers

from gazelle.studio import Server
from gazelle.studio.frame_passes import FramePasses, may_frame


def _headers(referer: str = "", dest: str = "iframe") -> Headers:
    headers = Headers({"Sec-Fetch-Dest": dest})
    if referer:
        headers["Referer"] = referer
    return headers


def _look(passes: FramePasses, token: str, *args: str) -> Any:
    return passes.look(f"/frame/{token}/", _headers(*args))


def test_the_first_page_of_this_machine_that_frames_a_view_is_the_only_one() -> None:
    passes = FramePasses()
    token = passes.issue()
    assert _look(passes, token, "http://localhost:8888/").ancestors == "http://localhost:8888"
    assert _look(passes, token, "http://localhost:8888/").refusal == ""
    assert _look(passes, token, "http://localhost:9999/").refusal == "another page shows this view"
    assert _look(passes, token, "https://localhost:8888/").refusal == "another page shows this view"


def test_a_page_of_another_machine_never_frames_a_view() -> None:
    passes = FramePasses()
    token = passes.issue()
    for place in ("https://evil.example/", "http://localhost.evil.example/", "http://[bad/"):
        framed = _look(passes, token, place)
        assert framed.refusal or framed.ancestors == "vscode-webview: vscode-file:", place
    assert _look(passes, token, "https://evil.example/").refusal == "another page shows this view"


def test_a_page_that_was_named_is_the_only_one() -> None:
    passes = FramePasses()
    token = passes.issue("https://hub.example")
    assert _look(passes, token, "https://hub.example/").ancestors == "https://hub.example"
    assert _look(passes, token, "http://localhost:8888/").refusal == "another page shows this view"


def test_without_an_origin_only_programs_frame_a_view() -> None:
    passes = FramePasses()
    framed = _look(passes, passes.issue())
    assert framed.ancestors == "vscode-webview: vscode-file:"


def test_what_a_page_says_of_itself_cannot_add_to_the_policy() -> None:
    passes = FramePasses()
    token = passes.issue()
    framed = _look(passes, token, "http://localhost:1;script-src */")
    assert framed.ancestors == "vscode-webview: vscode-file:"


@pytest.mark.parametrize("token", ["", "x", "ä", "%00", "../.."])
def test_who_does_not_know_the_pass_is_refused(token: str) -> None:
    passes = FramePasses()
    passes.issue()
    refusal = passes.look(f"/frame/{token}/", _headers()).refusal
    assert refusal == "this view has ended; run its cell again"


def test_a_pass_that_is_withdrawn_lets_nobody_in() -> None:
    passes = FramePasses()
    token, other = passes.issue(), passes.issue()
    passes.withdraw(token)
    passes.withdraw(token)
    assert _look(passes, token).refusal == "this view has ended; run its cell again"
    assert _look(passes, other).refusal == ""


def test_other_paths_are_none_of_a_pass() -> None:
    assert FramePasses().look("/frames/abc/", _headers()) is None


@pytest.mark.parametrize(
    "origin", ["http://localhost:8888", "http://127.0.0.1:1", "http://[::1]:5"]
)
def test_notebooks_of_this_machine_may_frame(origin: str) -> None:
    assert may_frame(origin)


def test_a_frame_is_served_with_its_own_policy_and_no_cookie(server: Server) -> None:
    frame = server.open_frame("http://localhost:8888")
    answer = _get(server, frame.path)
    assert answer.status == 200
    policy = answer.headers["Content-Security-Policy"]
    assert "frame-ancestors http://localhost:8888" in policy
    assert "'none'" not in policy.partition("frame-ancestors")[2]
    assert answer.headers["Set-Cookie"] is None
    assert server.is_reached(frame)


def test_everything_but_the_frame_stays_as_it_is(server: Server) -> None:
    server.open_frame("http://localhost:8888")
    answer = _get(server, f"/?token={server.token}")
    assert "frame-ancestors 'none'" in answer.headers["Content-Security-Policy"]
    assert _get(server, "/").status == 403


@pytest.mark.parametrize("headers", [{"Host": "evil.example"}, {"Origin": "http://localhost:8888"}])
def test_strangers_get_nothing_by_a_pass(server: Server, headers: dict[str, str]) -> None:
    frame = server.open_frame()
    assert _get(server, frame.path, **headers).status == 403


def test_a_frame_that_closes_ends_its_page_and_no_other(server: Server) -> None:
    one, other = server.open_frame(), server.open_frame()
    pages = [Page(server.port, path=f"{frame.path}ws") for frame in (one, other)]
    eventually(lambda: len(server.studio.pages) == 2)
    server.close_frame(one)
    eventually(lambda: len(server.studio.pages) == 1)
    assert pages[1].call("graph.get") is not None
    for page in pages:
        page.close()


def _get(server: Server, path: str, **headers: str) -> Any:
    import http.client

    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
    connection.putrequest("GET", path, skip_host="Host" in headers)
    for name, value in headers.items():
        connection.putheader(name, value)
    connection.endheaders()
    answer = connection.getresponse()
    answer.read()
    connection.close()
    return answer
