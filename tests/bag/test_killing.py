"""A recorder that is killed loses at most the last second, and its file opens at once."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.graph import Graph

_BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "soak" / "bag_kill.py"


@pytest.mark.parametrize(
    "words", [["rosbag", "record", "-O", "a", "/load"], ["ros2", "bag", "record", "-oa", "/load"]]
)
def test_a_killed_recorder_loses_less_than_a_second(
    words: list[str], tmp_path: Path, free_port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    spec = importlib.util.spec_from_file_location("bag_kill", _BENCHMARK)
    assert spec is not None and spec.loader is not None
    soak = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(soak)
    monkeypatch.setattr(soak, "ALLOWED_S", stretched(soak.ALLOWED_S))
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    with Graph.open() as graph:
        missing_s, _ = soak.run_once(graph, words, tmp_path, stretched(1.2))
    assert missing_s < stretched(1.0)
