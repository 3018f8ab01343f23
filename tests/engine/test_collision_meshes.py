"""Pieces of meshes are kept on disk, and are there what they were when they were made."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.description.model import MeshShape
from gazelle.engine import collision_meshes, decomposition_workers
from gazelle.engine.collision_meshes import decomposed, kept_file, mesh_key, pieces_folder
from gazelle.engine.decomposition_workers import split_ahead
from gazelle.geometry import (
    Mesh,
    announcing,
    cylinder_mesh,
    polyline_mesh,
    sphere_mesh,
    without_splitting,
)

pytest.importorskip("coacd")

_L_SHAPE = ((0.0, 0.0), (2.0, 0.0), (2.0, 0.2), (0.2, 0.2), (0.2, 2.0), (0.0, 2.0))


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    decomposed.cache_clear()
    return tmp_path / "cache" / "gazelle" / "pieces"


def _write(path: Path, mesh: Mesh) -> Path:
    vertices = "".join("v {:.9g} {:.9g} {:.9g}\n".format(*row) for row in mesh.vertices_m)
    faces = "".join("f {} {} {}\n".format(*(row + 1)) for row in mesh.faces)
    path.write_text(vertices + faces, encoding="utf-8")
    return path


def _bracket(path: Path, height_m: float = 1.0) -> Path:
    return _write(path, Mesh((polyline_mesh((_L_SHAPE,), height_m),)))


def _shape(path: Path, **words: Any) -> MeshShape:
    return MeshShape(path.as_uri(), path, **words)


def _made(path: Path, *, scenery: bool = False, **words: Any) -> Any:
    decomposed.cache_clear()
    return decomposed(mesh_key(_shape(path, **words), path, scenery=scenery))


def _same(one: Any, other: Any) -> bool:
    return bool(
        one.note == other.note
        and len(one.pieces) == len(other.pieces)
        and all(
            np.array_equal(a.points_m, b.points_m) and a.round_shape == b.round_shape
            for a, b in zip(one.pieces, other.pieces, strict=True)
        )
    )


def test_kept_pieces_are_those_that_were_made(
    tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    paths = [
        _bracket(tmp_path / "bracket.obj"),
        _write(tmp_path / "wheel.obj", Mesh((cylinder_mesh(0.3, 0.1),))),
        _write(tmp_path / "ball.obj", Mesh((sphere_mesh(0.2),))),
    ]
    made = [_made(path) for path in paths]
    assert len(made[0].pieces) > 1 and made[0].note.startswith(
        "it fills 32 % of its hull and collides as"
    )
    assert made[1].pieces[0].round_shape.half_length_m == pytest.approx(0.05)
    assert made[2].pieces[0].round_shape.half_length_m is None
    assert len(list(own_cache.iterdir())) == 3
    monkeypatch.setattr(collision_meshes, "load_mesh", None)
    assert all(_same(_made(path), one) for path, one in zip(paths, made, strict=True))


def test_pieces_belong_to_what_a_file_holds(tmp_path: Path, own_cache: Path) -> None:
    path = _bracket(tmp_path / "bracket.obj")
    made = _made(path)
    shutil.copy(path, tmp_path / "other.obj")
    assert _same(_made(tmp_path / "other.obj"), made)
    assert len(list(own_cache.iterdir())) == 1
    larger = _made(path, scale=(2.0, 2.0, 2.0))
    np.testing.assert_allclose(larger.pieces[0].points_m, 2 * made.pieces[0].points_m, atol=1e-6)
    _bracket(path, 0.5)
    assert not _same(_made(path), made)
    assert len(list(own_cache.iterdir())) == 3


def test_hull_that_stands_for_pieces_is_not_kept(tmp_path: Path) -> None:
    path = _bracket(tmp_path / "bracket.obj")
    with without_splitting():
        assert len(_made(path).pieces) == 1
        assert not pieces_folder().exists()
    made = _made(path)
    with without_splitting():
        assert _same(_made(path), made)


def test_hollow_scenery_is_left_out_without_splitting(tmp_path: Path) -> None:
    path = _bracket(tmp_path / "room.obj")
    with without_splitting():
        assert _made(path, scenery=True).pieces == ()
    assert _made(path, scenery=True).pieces


def test_damaged_file_of_pieces_is_made_anew(tmp_path: Path, own_cache: Path) -> None:
    path = _bracket(tmp_path / "bracket.obj")
    made = _made(path)
    (file,) = own_cache.iterdir()
    file.write_bytes(file.read_bytes()[:100])
    assert _same(_made(path), made)
    assert file.stat().st_size > 100


def test_pieces_of_a_mesh_of_several_files_or_a_pipe_are_not_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.gltf"
    path.write_text("{}")
    assert kept_file(mesh_key(_shape(path), path, scenery=False)) is None
    missing = tmp_path / "missing.obj"
    key = mesh_key(_shape(path), path, scenery=False)
    assert kept_file(key._replace(path=missing)) is None


def test_many_meshes_are_split_in_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(decomposition_workers, "_processors", lambda: 2)
    monkeypatch.setattr(decomposition_workers, "_TELL_EVERY_S", 0.0)
    paths = [_bracket(tmp_path / f"{index}.obj", 1.0 + index) for index in range(4)]
    (tmp_path / "none.obj").write_text("v 1 1\n")
    paths.append(tmp_path / "none.obj")
    said: list[str] = []
    with announcing(said.append):
        split_ahead((_shape(path), False) for path in (*paths, *paths, tmp_path / "missing.obj"))
    assert said[0] == (
        "making convex pieces of 5 meshes in 2 processes, which takes some seconds; this is done "
        f"once and kept in '{pieces_folder()}'"
    )
    assert all(" of 5 meshes: '" in line for line in said[1:]) and len(said) > 1
    assert len(list(pieces_folder().iterdir())) == 4
    kept = [_made(path) for path in paths[:4]]
    shutil.rmtree(pieces_folder())
    assert all(_same(_made(path), one) for path, one in zip(paths, kept, strict=False))
    said.clear()
    with announcing(said.append):
        split_ahead((_shape(path), False) for path in paths)
    assert said == []


def test_workers_that_die_lose_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decomposition_workers, "_processors", lambda: 2)
    monkeypatch.setattr(decomposition_workers.sys, "executable", shutil.which("false"))
    paths = [_bracket(tmp_path / f"{index}.obj", 1.0 + index) for index in range(4)]
    split_ahead((_shape(path), False) for path in paths)
    assert list(pieces_folder().iterdir()) == []
    assert len(_made(paths[0]).pieces) > 1
