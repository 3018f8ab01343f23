"""Sessions end without holding up what else goes on in the process."""

from __future__ import annotations

import gc

from tests.patience import eventually

from gazelle.graph.sessions import close_session


def test_a_closed_session_is_never_destroyed() -> None:
    """The transport's destructor waits for callbacks, and lets no thread run meanwhile."""
    done: list[str] = []

    class Session:
        def close(self) -> None:
            done.append("closed")

        def __del__(self) -> None:
            done.append("destroyed")

    close_session(Session(), lambda: done.append("then"))
    eventually(lambda: "then" in done)
    gc.collect()
    assert done == ["closed", "then"]
