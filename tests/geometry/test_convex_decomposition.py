from __future__ import annotations

import sys

import numpy as np
import pytest

from gazelle.geometry import (
    Mesh,
    box_mesh,
    convex_hull,
    convex_parts,
    is_closed,
    mesh_volume_m3,
    polyline_mesh,
    sphere_mesh,
)
from gazelle.user_folders import cache_folder

L_SHAPE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]


@pytest.fixture
def bracket() -> Mesh:
    return Mesh((polyline_mesh([L_SHAPE], 1.0),))


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache/gazelle"


def test_the_hull_of_a_convex_mesh_is_the_mesh(assert_well_formed):
    part = sphere_mesh(1.0)
    hull = convex_hull(part.vertices_m)
    assert_well_formed(hull)
    assert is_closed(hull)
    assert mesh_volume_m3(hull) == pytest.approx(mesh_volume_m3(part))


def test_the_hull_fills_hollows_and_forgets_inner_points(bracket):
    inner = np.concatenate([bracket.vertices_m, [[0.5, 0.5, 0.5]]])
    assert mesh_volume_m3(convex_hull(inner)) == pytest.approx(7.0)


@pytest.mark.parametrize(
    "points",
    [
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
        [[0, 0, 0], [1, 1, 1]],
        [[2, 3, 4]],
    ],
)
def test_flat_points_get_a_thin_hull(points):
    hull = convex_hull(np.array(points, float))
    assert is_closed(hull)
    assert mesh_volume_m3(hull) > 0
    np.testing.assert_allclose(hull.vertices_m.min(axis=0), np.min(points, axis=0), atol=1e-5)


@pytest.mark.parametrize("points", [[], [[np.nan, 0, 0]]])
def test_a_hull_of_nothing_says_so(points):
    with pytest.raises(ValueError, match="at least one point, all of them finite"):
        convex_hull(np.array(points, float))


def test_a_convex_mesh_is_one_exact_part():
    found = convex_parts(Mesh((box_mesh((1, 2, 3)),)))
    assert (len(found.parts), found.is_exact, found.note) == (1, True, "")


def test_without_coacd_the_hull_stands_in_and_says_so(bracket, monkeypatch):
    monkeypatch.setitem(sys.modules, "coacd", None)
    found = convex_parts(bracket)
    assert (len(found.parts), found.is_exact) == (1, False)
    assert "collides as its convex hull" in found.note
    assert "gazelle-sim[convex]" in found.note


def test_a_bracket_is_split_and_kept_on_disk(bracket, own_cache, monkeypatch):
    pytest.importorskip("coacd")
    found = convex_parts(bracket)
    assert found.is_exact
    assert len(found.parts) >= 2
    assert sum(map(mesh_volume_m3, found.parts)) == pytest.approx(5.0, rel=0.05)
    assert cache_folder() == own_cache
    (file,) = (own_cache / "convex").iterdir()
    monkeypatch.setitem(sys.modules, "coacd", None)
    again = convex_parts(bracket)
    assert str(file) in again.note
    for first, second in zip(found.parts, again.parts, strict=True):
        np.testing.assert_array_equal(
            np.sort(first.vertices_m, axis=0), np.sort(second.vertices_m, axis=0)
        )


def test_another_mesh_has_another_cache_file(bracket, own_cache):
    pytest.importorskip("coacd")
    convex_parts(bracket)
    convex_parts(bracket.scaled((1.0, 1.0, 2.0)))
    assert len(list((own_cache / "convex").iterdir())) == 2


@pytest.mark.parametrize("damage", [b"", b"PK broken", b"PK\3\4 broken"])
def test_a_damaged_cache_file_is_made_anew(bracket, own_cache, damage):
    pytest.importorskip("coacd")
    convex_parts(bracket)
    (file,) = (own_cache / "convex").iterdir()
    file.write_bytes(damage)
    assert len(convex_parts(bracket).parts) >= 2
    assert file.stat().st_size > 100


def test_the_order_in_which_pieces_are_finished_is_not_seen(bracket, tmp_path, monkeypatch):
    coacd = pytest.importorskip("coacd")
    first = convex_parts(bracket).parts
    split = coacd.run_coacd
    monkeypatch.setattr(coacd, "run_coacd", lambda *mesh, **how: split(*mesh, **how)[::-1])
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "other"))
    second = convex_parts(bracket).parts
    assert len(first) > 1
    for one, other in zip(first, second, strict=True):
        np.testing.assert_array_equal(one.vertices_m, other.vertices_m)
