"""Mesh files that claim more than they hold."""

from __future__ import annotations

import json
import struct
import time
from pathlib import Path

import numpy as np
import pytest

from gazelle.geometry import MeshError, load_mesh

_DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="9">{numbers}</float_array>
      <technique_common><accessor source="#a" count="3" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <vcount>{vcount}</vcount><p>0 1 2</p></polylist>
  </mesh></geometry></library_geometries>
  {nodes}
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""
_NODES = (
    '<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>'
    "</visual_scene></library_visual_scenes>"
)


def _refusal(path: Path, data: bytes | str) -> str:
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    start = time.thread_time()
    with pytest.raises(MeshError) as caught:
        load_mesh(path)
    assert time.thread_time() - start < 10.0
    return caught.value.reason


def _gltf(accessor: dict[str, object], view: dict[str, object] | None = None) -> str:
    position = {"componentType": 5126, "type": "VEC3", "count": 3, "bufferView": 0} | accessor
    buffer = "data:application/octet-stream;base64," + "AAAA" * 12
    document = {
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "accessors": [{key: item for key, item in position.items() if item is not None}],
        "bufferViews": [{"buffer": 0, "byteLength": 36, **(view or {})}],
        "buffers": [{"byteLength": 36, "uri": buffer}],
    }
    return json.dumps(document)


def test_stl_with_four_billion_triangles(tmp_path: Path) -> None:
    data = b"\0" * 80 + struct.pack("<I", 0xFFFFFFFF) + b"\0" * 50
    assert "the header promises 4294967295 triangles" in _refusal(tmp_path / "a.stl", data)


def test_gltf_values_that_no_buffer_holds(tmp_path: Path) -> None:
    text = _gltf({"bufferView": None, "count": 10**9})
    found = _refusal(tmp_path / "a.gltf", text)
    assert found == "1000000000 values are claimed that no buffer holds"
    text = _gltf({"count": 10**9}, {"byteStride": 0})
    assert _refusal(tmp_path / "b.gltf", text) == "byteStride 0 is less than one value needs"
    assert "a buffer is truncated: 12000000000 bytes needed" in _refusal(
        tmp_path / "c.gltf", _gltf({"count": 10**9})
    )
    assert "malformed glTF: OverflowError" in _refusal(
        tmp_path / "d.gltf", _gltf({}).replace('"count": 3', '"count": 1e400')
    )


def test_gltf_nodes_that_double(tmp_path: Path) -> None:
    nodes = [{"children": [number + 1, number + 1]} for number in range(60)] + [{}]
    text = json.dumps({"nodes": nodes, "scenes": [{"nodes": [0]}]})
    assert _refusal(tmp_path / "a.gltf", text) == "the scene has more than 20000 nodes"
    assert "does not fit into the memory" in _refusal(tmp_path / "b.gltf", "[" * 100_000)


def test_collada_nodes_that_double(tmp_path: Path) -> None:
    library = "".join(
        f'<node id="n{k}">' + f'<instance_node url="#n{k + 1}"/>' * 2 + "</node>"
        for k in reversed(range(30))
    )
    nodes = f'<library_nodes><node id="n30"/>{library}</library_nodes>' + _NODES.replace(
        '<instance_geometry url="#g"/>', '<instance_node url="#n0"/>'
    )
    text = _DAE.format(numbers="0 0 0 1 0 0 0 1 0", vcount="3", nodes=nodes)
    assert _refusal(tmp_path / "a.dae", text) == "the scene has more than 20000 nodes"


def test_collada_counts_of_corners(tmp_path: Path) -> None:
    plain = {"numbers": "0 0 0 1 0 0 0 1 0", "vcount": "3", "nodes": _NODES}
    (tmp_path / "good.dae").write_text(_DAE.format(**plain))
    assert len(load_mesh(tmp_path / "good.dae").parts[0].faces) == 1
    text = _DAE.format(**plain | {"vcount": "2000000000"})
    found = _refusal(tmp_path / "a.dae", text)
    assert found == "<vcount> claims 2000000000 corners, <p> has 3"


@pytest.mark.parametrize("number", ["nan", "inf", "1e999"])
def test_vertices_that_are_nowhere(tmp_path: Path, number: str) -> None:
    if number != "nan":
        # pycollada makes 0 of what is no number.
        text = _DAE.format(numbers=f"{number} 0 0 1 0 0 0 1 0", vcount="3", nodes=_NODES)
        assert "is not of finite numbers" in _refusal(tmp_path / "a.dae", text)
    value = np.array([float(number)] + [0] * 8, "<f4").tobytes()
    data = b"\0" * 80 + struct.pack("<I", 1) + b"\0" * 12 + value + b"\0\0"
    assert "is not a finite number" in _refusal(tmp_path / "a.stl", data)


def test_mesh_files_larger_than_a_gibibyte_are_not_read(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    with path.open("wb") as stream:
        stream.truncate((1 << 30) + 1)
    with pytest.raises(MeshError, match="it has 1073741825 bytes, the limit is 1024 MiB"):
        load_mesh(path)
