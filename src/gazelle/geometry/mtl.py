"""Wavefront MTL material libraries."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.documents.names import is_file
from gazelle.geometry.mesh import MeshMaterial, MeshNote

__all__ = ["read_mtl"]


def read_mtl(text: str, file: Path) -> tuple[dict[str, MeshMaterial], tuple[MeshNote, ...]]:
    """Read a library's text.

    Returns:
        materials by name; notes about textures that are missing and lines that make no sense.
    """
    materials: dict[str, MeshMaterial] = {}
    notes: list[MeshNote] = []
    current = ""
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "newmtl":
            current = " ".join(words[1:])
            materials[current] = MeshMaterial(current)
        elif current:
            try:
                materials[current] = _with(materials[current], words, file, notes)
            except (ValueError, IndexError):
                text_ = f"'{file.name}' line {number}: '{line.strip()}' cannot be understood"
                notes.append(MeshNote("mesh.incomplete", text_))
    return materials, tuple(notes)


def _with(
    material: MeshMaterial, words: list[str], file: Path, notes: list[MeshNote]
) -> MeshMaterial:
    key = words[0].lower()
    if key == "ka":
        return replace(material, ambient=(*_rgb(words), 1.0))
    if key == "kd":
        return replace(material, diffuse=(*_rgb(words), material.diffuse[3]))
    if key == "ks":
        return replace(material, specular=(*_rgb(words), 1.0))
    if key == "ke":
        return replace(material, emissive=(*_rgb(words), 1.0))
    if key in {"d", "tr"}:
        value = float(words[-1])
        opacity = value if key == "d" else 1.0 - value
        return replace(material, diffuse=(*material.diffuse[:3], opacity))
    if key == "ns":
        return replace(material, shininess=float(words[1]))
    if key == "map_kd":
        return _textured(material, words[-1], file, notes)
    return material


def _rgb(words: list[str]) -> tuple[float, float, float]:
    return (float(words[1]), float(words[2]), float(words[3]))


def _textured(material: MeshMaterial, name: str, file: Path, notes: list[MeshNote]) -> MeshMaterial:
    plain = name.replace("\\", "/")
    leaf = Path(plain).name
    folder = file.parent
    for path in (
        folder / plain,
        folder / leaf,
        folder.parent / "materials" / "textures" / leaf,
    ):
        if is_file(path):
            return replace(material, texture=path)
    text = f"texture '{name}' not found beside '{file.name}', the part is shown plain"
    notes.append(MeshNote("mesh.missing-texture", text))
    return material
