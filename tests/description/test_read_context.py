from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import Diagnostics
from gazelle.workspace.file_lookup import Resolved


def test_without_workspace_only_paths_are_found(tmp_path):
    context = ReadContext(None, Diagnostics(), "a.sdf", tmp_path)
    (tmp_path / "a.stl").write_bytes(b"")
    assert context.resolve("a.stl").path == tmp_path / "a.stl"
    assert context.resolve(f"file://{tmp_path}/a.stl").path == tmp_path / "a.stl"
    assert context.resolve("b.stl").tried == (str(tmp_path / "b.stl"),)
    assert context.resolve("model://box").note == "there is no workspace to look in"


def test_included_files_extend_the_chain_and_share_the_cache(tmp_path):
    outer = ReadContext(None, Diagnostics(), "a.sdf", tmp_path)
    inner = outer.for_file(tmp_path / "deep" / "b.sdf").for_version((1, 4))
    assert inner.include_chain == (tmp_path / "deep" / "b.sdf",)
    assert (inner.base_dir, inner.version) == (tmp_path / "deep", (1, 4))
    assert inner.cache is outer.cache


def test_equal_things_are_new_once(tmp_path):
    context = ReadContext(None, Diagnostics(), "a.sdf")
    assert [context.first_time("mesh", "a.stl") for _ in range(3)] == [True, False, False]
    assert context.for_file(tmp_path / "b.sdf").first_time("mesh", "a.stl") is False


def test_what_a_document_names_often_is_looked_for_once(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("")
    asked: list[str] = []

    class Counting:
        def resolve(self, uri: str, *, base_dir: Path | None = None) -> Resolved:
            asked.append(uri)
            return Resolved(None if uri == "model://gone" else tmp_path / "a.txt")

    workspace: Any = Counting()
    context = ReadContext(workspace, Diagnostics(), "a.world", tmp_path)
    for _ in range(3):
        assert context.resolve("model://chair").path == tmp_path / "a.txt"
        assert context.for_version((1, 6)).resolve("model://gone").path is None
        context.for_file(tmp_path / "b" / "b.sdf").resolve("model://chair")
    assert asked == ["model://chair", "model://gone", "model://chair"]
