"""Materials by script name and ``<uri>``s, as SDF's ``<material><script>`` asks for them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.description.materials.gazebo_materials import (
    GAZEBO_MATERIAL_NAMES,
    gazebo_material,
    picture_colour,
)
from gazelle.description.materials.ogre_scripts import OgreMaterial, parse_material_script
from gazelle.description.model import Material, Rgba
from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents import TEXT_BYTES, read_limited
from gazelle.documents.files import is_file, is_folder

__all__ = ["material_from_scripts"]

_MAX_BASE_DEPTH = 8


def material_from_scripts(
    name: str, uris: Sequence[str], context: ReadContext, *, span: SourceSpan | None = None
) -> Material | None:
    """Return a material by its name in OGRE scripts, or among Gazebo's own.

    Args:
        name: the script's material, such as ``ISCAS_groundplane/Image`` or ``Gazebo/Grey``.
        uris: script files, folders with scripts and folders with textures.
        context: resolves the URIs and hears of problems.
        span: the place that asks, for messages.

    Returns:
        The material; None (with ``material.unknown`` reported) when nobody knows the name.
    """
    wanted = name.strip()
    folders = [path for uri in uris if (path := _locate(uri, context, span)) is not None]
    materials: dict[str, OgreMaterial] = {}
    for script in _scripts(folders):
        materials = _read(script, context) | materials
    if wanted in materials:
        return _compiled(materials, wanted, _texture_folders(folders), context)
    own = gazebo_material(wanted)
    if not context.first_time("material", wanted, context.file):
        return own
    if own is None:
        _report_unknown(wanted, materials, context, span)
    elif picture_colour(wanted):
        message = f"'{wanted}' has a picture in Gazebo; it is shown in the picture's mean colour"
        context.diagnostics.report("material.plain-colour", message, span)
    return own


def _report_unknown(
    name: str, materials: dict[str, OgreMaterial], context: ReadContext, span: SourceSpan | None
) -> None:
    fix = did_you_mean(name, [*materials, *GAZEBO_MATERIAL_NAMES])
    message = f"material '{name}' is not known; the surface is shown in grey"
    context.diagnostics.report("material.unknown", message, span, fix=fix)


def _locate(uri: str, context: ReadContext, span: SourceSpan | None) -> Path | None:
    if uri.strip().endswith("/gazebo.material") or "://media/materials" in uri:
        return None  # Gazebo's own scripts: their facts are in our table
    found = context.resolve(uri)
    if found.path is None and context.first_time("script", uri, context.file):
        context.diagnostics.report("material.script-missing", found.explain(uri.strip()), span)
    return found.path


def _scripts(folders: Sequence[Path]) -> list[Path]:
    scripts: list[Path] = []
    for path in folders:
        if is_folder(path):
            scripts += sorted(path.glob("*.material"))
        elif path.suffix == ".material":
            scripts.append(path)
    return scripts


def _read(script: Path, context: ReadContext) -> dict[str, OgreMaterial]:
    """Return a script's materials, read once however many visuals name it."""
    key = ("material script", script)
    if key not in context.cache:
        context.cache[key] = parse_material_script(
            _text_of(script, context), str(script), context.diagnostics
        )
    found: dict[str, OgreMaterial] = context.cache[key]
    return found


def _text_of(script: Path, context: ReadContext) -> str:
    try:
        return read_limited(script, TEXT_BYTES).decode("utf-8", errors="replace")
    except OSError as error:
        message = f"material script '{script}' cannot be read: {error.strerror}"
        context.diagnostics.report("material.bad-script", message, SourceSpan(str(script)))
        return ""


def _texture_folders(folders: Sequence[Path]) -> list[Path]:
    """Return where OGRE would look: the folders named, and ``textures`` beside ``scripts``."""
    named = [path if is_folder(path) else path.parent for path in folders]
    return [*named, *(path.parent / "textures" for path in named)]


def _compiled(
    materials: dict[str, OgreMaterial],
    name: str,
    texture_folders: Sequence[Path],
    context: ReadContext,
) -> Material:
    chain = _with_bases(materials, name)
    colours: dict[str, tuple[float, ...]] = {}
    for item in reversed(chain):
        colours |= {kind: values for kind, values in item.colours.items() if len(values) >= 3}
    specular = colours.get("specular", (0.0, 0.0, 0.0))
    textured = next((item for item in chain if item.texture), chain[0])
    return Material(
        name=name,
        ambient=_rgba(colours.get("ambient", (1.0, 1.0, 1.0))),
        diffuse=_rgba(colours.get("diffuse", (1.0, 1.0, 1.0))),
        specular=_rgba(specular[:3]),
        emissive=_rgba(colours.get("emissive", (0.0, 0.0, 0.0))),
        # OGRE: 'specular r g b [a] shininess'
        shininess=specular[-1] if len(specular) > 3 else 0.0,
        texture=_texture(textured, texture_folders, context),
        texture_scale=(1.0 / textured.scale[0], 1.0 / textured.scale[1]),
        lighting=all(item.lighting for item in chain),
    )


def _with_bases(materials: dict[str, OgreMaterial], name: str) -> list[OgreMaterial]:
    """Return the material and those it starts from; a circle ends where it closes."""
    chain = [materials[name]]
    while chain[-1].base in materials and len(chain) < _MAX_BASE_DEPTH:
        chain.append(materials[chain[-1].base])
    return chain


def _texture(material: OgreMaterial, folders: Sequence[Path], context: ReadContext) -> Path | None:
    if not material.texture:
        return None
    for folder in folders:
        path = folder / material.texture
        if is_file(path):
            return path
    if not context.first_time("texture", material.span):
        return None
    places = "".join(f"\n    {folder}" for folder in folders)
    message = f"picture '{material.texture}' of '{material.name}' not found; looked in:{places}"
    context.diagnostics.report("material.texture-missing", message, material.span)
    return None


def _rgba(values: tuple[float, ...]) -> Rgba:
    alpha = values[3] if len(values) > 3 else 1.0
    return (values[0], values[1], values[2], alpha)
