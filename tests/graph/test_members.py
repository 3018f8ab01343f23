"""Everybody is linked to everybody, or finds out."""

from __future__ import annotations

import json
import os
import socket
import stat
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest

from gazelle.graph import Graph, relink
from gazelle.graph.keys import MEMBERS_KEY
from gazelle.graph.locators import is_hub
from gazelle.graph.members import hear_of_members

Join = Callable[..., Graph]
Wait = Callable[..., Any]


def cut_direct_links(port: int) -> None:
    """End all links of this process but those to the hub."""
    for number in range(1024):
        with suppress(OSError):
            if not stat.S_ISSOCK(os.fstat(number).st_mode):
                continue
            with socket.socket(fileno=os.dup(number)) as one:
                names = (one.getpeername(), one.getsockname())
                if any(names) and not any(is_hub(name, port) for name in names):
                    one.shutdown(socket.SHUT_RDWR)


def is_linked(one: Graph, other: Graph) -> bool:
    return other.zid in map(str, one.session.info.peers_zid())


def test_hub_tells_who_is_there_when_somebody_comes_or_goes(join: Join, eventually: Wait) -> None:
    first = join(role="hub")
    lists: list[list[str]] = []
    subscriber: Any = first.session.declare_subscriber(
        MEMBERS_KEY, lambda sample: lists.append(json.loads(sample.payload.to_string()))
    )
    second = join()
    eventually(lambda: lists and lists[-1] == sorted([first.zid, second.zid]))
    second.close()
    eventually(lambda: lists[-1] == [first.zid])
    subscriber.undeclare()


def test_process_without_a_link_to_another_joins_the_hub_again(
    join: Join, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As when a link was never opened, which nobody is told of."""
    monkeypatch.setattr(relink.Relinker, "lost", lambda self, zid: self._linked.discard(zid))
    monkeypatch.setattr(relink, "_MISSED_S", (0.1, 1.0, 5.0, 20.0))
    first, second = join(role="hub"), join()
    eventually(lambda: is_linked(first, second) and is_linked(second, first))
    cut_direct_links(first.port)
    eventually(lambda: not is_linked(second, first))
    # As the hub says it when somebody else comes or goes.
    members = json.dumps(sorted([first.zid, second.zid]))
    second.session.put(MEMBERS_KEY, members)
    eventually(lambda: is_linked(first, second) and is_linked(second, first))


@pytest.mark.parametrize("payload", [b"", b"{", b"[1]", b"\xff", b"{}", b"[" * 100_000])
def test_list_that_is_none_is_nobodys(
    payload: bytes, graph: Graph, other: Graph, eventually: Wait
) -> None:
    heard: list[frozenset[str]] = []
    subscriber = hear_of_members(other.session, heard.append)
    good = json.dumps([other.zid, "another"])
    for one in (payload, good):
        graph.session.put(MEMBERS_KEY, one)
    eventually(lambda: frozenset({"another"}) in heard)
    assert frozenset() not in heard
    subscriber.undeclare()
