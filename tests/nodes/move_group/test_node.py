"""What move_group says while it comes up."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.nodes.move_group import node as module


class _Node:
    def __init__(self) -> None:
        self.told = threading.Event()
        self.lines: list[tuple[str, str]] = []

    def log(self, level: str, text: str) -> None:
        self.lines.append((level, text))
        self.told.set()


def test_kernels_that_are_compiled_are_told_while_somebody_waits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, "_PATIENCE_S", 0.0)
    node: Any = _Node()
    with module._told_if_long(node):
        assert node.told.wait(stretched())
    ((level, text),) = node.lines
    assert level == "info"
    assert text.startswith("compiling what kinematics and planning need, which takes half a minute")


def test_kernels_that_are_there_are_not_told_of() -> None:
    node: Any = _Node()
    with module._told_if_long(node):
        pass
    assert node.lines == []
