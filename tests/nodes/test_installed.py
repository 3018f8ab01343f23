"""A node of an installed package runs as a built-in one does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.installed_packages import code_of_page, installed

_POINTS = {"gazelle.nodes": {"far_pkg/beat": "far_parts:BEAT"}}


def test_a_node_of_an_installed_package_is_started_by_its_name(bench: Any, tmp_path: Path) -> None:
    with installed(tmp_path, "far_parts", code_of_page("A node"), _POINTS):
        got = bench.listen("/ns/beat", "std_msgs/msg/Bool")
        bench.start("far_pkg/beat", "__ns:=/ns")
        bench.eventually(lambda: got)
        assert got[0].data is True
        assert bench.stop() == [0]
