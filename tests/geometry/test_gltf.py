from __future__ import annotations

import base64
import json
import struct

import numpy as np
import pytest

from gazelle.geometry import MeshError, load_mesh

POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4")
UV = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], "<f4")
INDICES = np.array([0, 1, 2, 0, 2, 3], "<u2")
BUFFER = POSITIONS.tobytes() + UV.tobytes() + INDICES.tobytes()


def document(**changes) -> dict:
    plain = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "plate"}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0, "TEXCOORD_0": 1},
                        "indices": 2,
                        "material": 0,
                    }
                ]
            }
        ],
        "materials": [
            {
                "name": "red",
                "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]},
                "alphaMode": "BLEND",
            }
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 32},
            {"buffer": 0, "byteOffset": 80, "byteLength": 12},
        ],
        "buffers": [{"byteLength": len(BUFFER), "uri": "a.bin"}],
    }
    return plain | changes


def glb(content: dict, binary: bytes = BUFFER) -> bytes:
    content["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


@pytest.fixture
def gltf(write):
    def make(**changes):
        write("a.bin", BUFFER)
        return write("a.gltf", json.dumps(document(**changes)))

    return make


def test_a_square_is_read(gltf, assert_well_formed):
    mesh = load_mesh(gltf())
    (part,) = mesh.parts
    assert_well_formed(part)
    assert (part.name, len(part.vertices_m), len(part.faces)) == ("plate", 4, 2)
    # glTF counts v downwards, we count it upwards.
    np.testing.assert_array_equal(part.uv, part.vertices_m[:, :2])
    assert (part.material.name, part.material.diffuse) == ("red", (1, 0, 0, 0.5))


def test_binary_and_embedded_files_give_the_same(gltf, write):
    plain = load_mesh(gltf())
    packed = load_mesh(write("a.glb", glb(document())))
    uri = "data:application/octet-stream;base64," + base64.b64encode(BUFFER).decode()
    embedded = load_mesh(gltf(buffers=[{"byteLength": len(BUFFER), "uri": uri}]))
    for other in (packed, embedded):
        np.testing.assert_array_equal(other.vertices_m, plain.vertices_m)
        np.testing.assert_array_equal(other.faces, plain.faces)


def test_node_transforms_are_applied_and_axes_kept(gltf):
    half = 0.5**0.5
    nodes = [
        {"children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2]},
        {"mesh": 0, "name": "inner", "rotation": [0, 0, half, half]},
    ]
    mesh = load_mesh(gltf(nodes=nodes))
    np.testing.assert_allclose(mesh.bounds_m, [(8, 0, 0), (10, 2, 0)], atol=1e-6)
    matrix = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]
    mesh = load_mesh(gltf(nodes=[{"mesh": 0, "matrix": matrix}]))
    np.testing.assert_allclose(mesh.bounds_m, [(4, 0, 0), (5, 1, 0)], atol=1e-6)


@pytest.mark.parametrize(("mode", "order"), [(5, [0, 1, 3, 2]), (6, [0, 1, 2, 3])])
def test_strips_and_fans_are_triangles(gltf, write, mode, order, assert_well_formed):
    content = document()
    primitive = content["meshes"][0]["primitives"][0]
    primitive["mode"] = mode
    content["accessors"][2]["count"] = 4
    binary = BUFFER[:80] + np.array(order, "<u2").tobytes()
    (part,) = load_mesh(write("a.glb", glb(content, binary))).parts
    assert_well_formed(part)
    assert len(part.faces) == 2
    assert (part.normals[:, 2] == 1).all()


def test_interleaved_and_normalised_values_are_read(write):
    record = np.zeros(4, [("p", "<f4", 3), ("uv", "<u2", 2)])
    record["p"], record["uv"] = POSITIONS, UV * 65535
    content = document()
    content["bufferViews"] = [
        {"buffer": 0, "byteLength": record.nbytes, "byteStride": 16},
        {"buffer": 0, "byteOffset": 12, "byteLength": record.nbytes - 12, "byteStride": 16},
        {"buffer": 0, "byteOffset": 64, "byteLength": 12},
    ]
    content["accessors"][1] |= {"componentType": 5123, "normalized": True}
    (part,) = load_mesh(write("a.glb", glb(content, record.tobytes() + INDICES.tobytes()))).parts
    np.testing.assert_array_equal(part.uv, part.vertices_m[:, :2])


def test_sparse_values_are_put_in(write):
    content = document()
    content["accessors"][0]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": 3, "componentType": 5123},
        "values": {"bufferView": 4},
    }
    content["bufferViews"] += [
        {"buffer": 0, "byteOffset": 92, "byteLength": 2},
        {"buffer": 0, "byteOffset": 96, "byteLength": 12},
    ]
    binary = BUFFER + struct.pack("<HH3f", 2, 0, 3, 3, 0)
    assert load_mesh(write("a.glb", glb(content, binary))).bounds_m[1] == (3, 3, 0)


def test_embedded_textures_are_bytes_and_named_ones_paths(gltf, write):
    surface = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    changes = {"materials": [surface], "textures": [{"source": 0}]}
    picture = write("p q.png", b"png")
    named = load_mesh(gltf(**changes, images=[{"uri": "p%20q.png"}]))
    assert named.parts[0].material.texture == picture
    view = {"images": [{"bufferView": 2, "mimeType": "image/png"}]}
    packed = load_mesh(write("a.glb", glb(document(**changes, **view))))
    assert packed.parts[0].material.texture == INDICES.tobytes()
    missing = load_mesh(gltf(**changes, images=[{"uri": "gone.png"}]))
    assert missing.notes[0].code == "mesh.missing-texture"


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"buffers": [{"uri": "gone.bin"}]}, "its buffer"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "KHR_draco_mesh_compression"),
        ({"nodes": [{"children": [0]}]}, "nested in a cycle"),
        ({"nodes": [{}]}, "the glTF scene has no triangles"),
        ({"accessors": []}, "malformed glTF: IndexError"),
    ],
)
def test_a_broken_file_says_why(gltf, changes, reason):
    with pytest.raises(MeshError, match=reason):
        load_mesh(gltf(**changes))


def test_truncated_files_say_how_much_is_missing(write):
    data = glb(document())
    with pytest.raises(MeshError, match=rf"truncated GLB: {len(data)} bytes promised, 100 found"):
        load_mesh(write("a.glb", data[:100]))
    with pytest.raises(MeshError, match="a buffer is truncated: 92 bytes needed, 80 there"):
        load_mesh(write("b.glb", glb(document(), BUFFER[:80])))


@pytest.mark.reference
def test_trimesh_reads_the_same(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    theirs = trimesh.creation.icosphere(subdivisions=2)
    theirs.export(tmp_path / "s.glb")
    ours = load_mesh(tmp_path / "s.glb")
    assert len(ours.faces) == len(theirs.faces)
    np.testing.assert_allclose(ours.bounds_m, theirs.bounds, atol=1e-6)
