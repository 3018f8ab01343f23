"""Work that takes seconds is told before it begins."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gazelle.description.loader import load_models
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.simulator.world_server import WorldServer
from gazelle.workspace import Workspace

pytest.importorskip("coacd")


def _bracket(path: Path, height_cm: float = 1.0) -> None:
    """Write an L of 2 × 2 cm as a binary STL."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    low = np.array([(x, y, 0) for x, y in outline], float) / 100
    high = low + np.array([0, 0, height_cm / 100])
    tops = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    triangles = [high[list(t)] for t in tops] + [low[list(reversed(t))] for t in tops]
    for i in range(6):
        j = (i + 1) % 6
        triangles += [np.array([low[i], low[j], high[j]]), np.array([low[i], high[j], high[i]])]
    rows = np.zeros(len(triangles), np.dtype([("n", "<3f4"), ("t", "<9f4"), ("a", "<u2")]))
    rows["t"] = np.array(triangles).reshape(-1, 9)
    path.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())


def test_splitting_a_mesh_is_announced_once_and_explained_at_the_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    _bracket(tmp_path / "bracket.stl")
    _bracket(tmp_path / "other.stl", 0.5)
    text = f"""<robot name="r"><link name="base"><inertial><mass value="1"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
      <mesh filename="file://{tmp_path}/bracket.stl"/></geometry></collision><collision><geometry>
      <mesh filename="file://{tmp_path}/other.stl"/></geometry></collision></link></robot>"""
    workspace, found = Workspace.discover(environ={}, cwd=tmp_path), Diagnostics()
    (model,) = load_models(text, workspace=workspace, diagnostics=found)
    said: list[str] = []
    server = WorldServer(World(), progress=said.append)
    server.spawn(model)
    server.spawn(model, name="again", T_world_model=Pose((0.0, 0.0, 1.0)))
    server.close()
    folder = tmp_path / "cache" / "gazelle" / "convex"
    assert said == [
        "splitting 'bracket.stl' into convex pieces, which takes some seconds; this is done once"
        f" and kept in '{folder}'",
        "splitting 'other.stl' into convex pieces",
    ]
