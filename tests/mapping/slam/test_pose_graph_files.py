"""Files of pose graphs, and what is no such file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gazelle.mapping.slam import Slam, SlamParameters, load_graph, save_graph
from gazelle.mapping.slam.pose_graph_files import SavedGraphError


def _with_format(path: Path, text: str) -> None:
    save_graph(Slam(SlamParameters()), path)
    with np.load(path) as found:
        columns = dict(found)
    columns["format"] = np.array(text)
    with path.open("wb") as file:
        np.savez_compressed(file, **columns)


def test_a_newer_gazelles_graph_is_refused_with_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "a.posegraph"
    _with_format(path, "gazelle posegraph 2")
    text = r"a.posegraph is of version 2, saved by a newer Gazelle; this one reads versions up to 1"
    with pytest.raises(SavedGraphError, match=text):
        load_graph(path, SlamParameters())


def test_another_format_is_named(tmp_path: Path) -> None:
    path = tmp_path / "a.posegraph"
    _with_format(path, "karto")
    text = r"holds no graph of poses that Gazelle has written \(it is 'karto', not 'gazelle pose"
    with pytest.raises(SavedGraphError, match=text):
        load_graph(path, SlamParameters())
