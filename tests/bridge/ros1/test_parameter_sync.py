"""In which order the parameters of a master that ROS 1 runs come to the graph."""

from __future__ import annotations

from typing import Any

from gazelle.bridge.ros1.parameter_sync import ParameterSync
from gazelle.graph.parameter_tree import ParameterTree


class _Store:
    """The graph's parameters, and what happened to them."""

    def __init__(self, **values: Any) -> None:
        self.tree = ParameterTree(values)
        self.done: list[str] = []

    def get(self, name: str, default: Any) -> Any:
        return self.tree.get(name) if self.tree.has(name) else default

    def set(self, name: str, value: Any) -> None:
        self.tree.set(name, value)
        self.done.append(name)

    def on_change(self, listener: Any) -> None:
        self.done.append("listens")


def test_the_run_id_comes_when_everything_else_is_there() -> None:
    """A launch waits for it, and what it sets then is not written over."""
    store = _Store(ours=5)
    asked: list[tuple[Any, ...]] = []

    def ask(*words: Any) -> Any:
        asked.append(words)
        return {"run_id": "r", "x": 1, "a": {"b": 2}}

    sync = ParameterSync(store, ask, "/bridge", lambda text: None)  # type: ignore[arg-type]
    sync.start("http://localhost:1/")
    assert sorted(store.done[:-2]) == ["/a/b", "/x"]
    assert store.done[-2:] == ["listens", "/run_id"]
    assert ("setParam", "/bridge", "/ours", 5) in asked
    sync.close()


def test_a_master_that_is_coming_up_is_not_told_our_run_id() -> None:
    """Its roscore ends where it finds another one than its own."""
    store = _Store(run_id="of the master before", ours=5)
    asked: list[tuple[Any, ...]] = []

    def ask(*words: Any) -> Any:
        asked.append(words)
        return {}

    sync = ParameterSync(store, ask, "/bridge", lambda text: None)  # type: ignore[arg-type]
    sync.start("http://localhost:1/")
    assert ("setParam", "/bridge", "/ours", 5) in asked
    assert not [words for words in asked if "/run_id" in words]
    sync.close()
