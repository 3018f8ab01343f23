"""A world as an MJCF file: bodies, joints and contacts as the engine has them, with every digit."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.description.model import Model, World
from gazelle.description.writers.output_files import Converted, OutputFiles
from gazelle.description.writers.xml_markup import Markup, head_comments, number, numbers
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.engine.compiler import Assembly, Compiled, assemble_world, compile_assembly
from gazelle.engine.mjcf.visual_writer import VisualWriter, obj_bytes
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import root_joint
from gazelle.engine.state import initial_data
from gazelle.engine.wheel_slip import described_slips
from gazelle.errors import EngineError

__all__ = ["exact_xml", "to_mjcf"]


_EXACT_DIGITS = 17
_SETTER = "_mjPRIVATE__set_xml_precision"
_GETTER = "_mjPRIVATE__get_xml_precision"


# Attributes that are names, however much they look like numbers.
_NAMES = frozenset({
    "body", "body1", "body2", "class", "file", "geom1", "geom2", "hfield", "joint", "joint1",
    "joint2", "material", "mesh", "name", "site", "target", "tendon", "texture",
})  # fmt: skip


# Of meshes: long, and in files in the end.
_TRIANGLES = frozenset({"face", "normal", "texcoord", "vertex"})
# Kept in single precision by MuJoCo; the model has them as they were meant.
_COLOURS = frozenset({"emission", "rgba", "shininess", "specular"})
_AS_IS = _NAMES | _TRIANGLES
_START = "start"


def to_mjcf(
    world: World, *, diagnostics: Diagnostics, output_files: OutputFiles | None = None
) -> Converted:
    """Write a world as an MJCF file that plain MuJoCo loads.

    It moves as in the engine as long as nothing acts from outside: the same joints, contacts,
    constraints and solver settings. Only falling asleep is turned off, for which MuJoCo wants
    lengths that no file can hold.

    Args:
        world: any.
        diagnostics: receives ``convert.…`` for what is not in the file, and the engine's own
            findings.
        output_files: where the text will stand; meshes and textures go beside it.

    Raises:
        EngineError: MuJoCo refuses the world.
    """
    found = Diagnostics()
    output = output_files or OutputFiles(relative=True)
    assembly = assemble_world(world, step_s=world.physics.max_step_size_s, diagnostics=diagnostics)
    if len(world.models) == 1:
        assembly.builder.spec.modelname = world.models[0].name
    visuals = VisualWriter(assembly.builder, output, found)
    visuals.add()
    _forbid_sleep(assembly)
    compiled = compile_assembly(assembly)
    _forget_decays(assembly, compiled, found)
    spec = assembly.builder.spec
    try:
        spec.copy_back(compiled.model)
    except ValueError as error:
        raise EngineError(f"MuJoCo cannot write the world: {error}") from error
    root = parse_xml(exact_xml(spec), "<mjcf>", found)
    assert root is not None, "MuJoCo writes well-formed XML"
    files = _FileMaker(compiled, visuals, output)
    document = _rewritten(root, files.mesh)
    _add_start(document, compiled, world)
    _report_outside(world, found)
    for item in found:
        diagnostics.add(item)
    source = world.file.name if world.file else f"'{world.name}'"
    return Converted(document.to_text(head_comments(source, found)), output.files)


def exact_xml(spec: Any) -> str:
    """Return the XML of a compiled spec; its numbers are read back as the same.

    Raises:
        EngineError: MuJoCo cannot write the spec.
    """
    with _all_digits():
        try:
            return str(spec.to_xml())
        except ValueError as error:
            raise EngineError(f"MuJoCo cannot write the world: {error}") from error


@contextmanager
def _all_digits() -> Iterator[None]:
    """Set the writer's digits for a while; MuJoCo exports the setting without a header for it.

    A library without it writes six digits, which is a description still, only not an exact one.
    """
    library = _library()
    if library is None:
        yield
        return
    before = getattr(library, _GETTER)()
    getattr(library, _SETTER)(_EXACT_DIGITS)
    try:
        yield
    finally:
        getattr(library, _SETTER)(before)


def _library() -> Any:
    for path in sorted(Path(mujoco.__file__).parent.glob("*mujoco*")):
        if path.name.startswith(("libmujoco", "mujoco.dll")):
            library = ctypes.CDLL(str(path))
            if hasattr(library, _SETTER) and hasattr(library, _GETTER):
                return library
    return None


def _forbid_sleep(assembly: Assembly) -> None:
    spec: Any = assembly.builder.spec
    spec.option.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    spec.option.sleep_tolerance = mujoco.MjOption().sleep_tolerance
    for body in spec.bodies:
        body.sleep = mujoco.mjtSleepPolicy.mjSLEEP_AUTO


def _forget_decays(assembly: Assembly, compiled: Compiled, found: Diagnostics) -> None:
    """Take out SDF's velocity_decay: a free joint of MJCF has one damping for all directions."""
    model = compiled.model
    for decay in assembly.builder.decays:
        start = int(model.joint(root_joint(decay.link_name)).dofadr[0])
        model.dof_damping[start : start + 6] = 0.0
        model.dof_armature[start : start + 6] = 0.0
        message = f"velocity_decay of link '{decay.link_name}' has no word in MJCF"
        found.report("convert.left-out", message)


class _FileMaker:
    """Turns meshes that stand in the text into files beside it."""

    def __init__(
        self, compiled: Compiled, visuals: VisualWriter, output_files: OutputFiles
    ) -> None:
        self._model = compiled.model
        self._looks = visuals
        self._beside = output_files

    def mesh(self, markup: Markup) -> None:
        """Replace a mesh's vertices by a file; they stay where there is no folder for one."""
        name = markup.attributes["name"]
        file, data = self._looks.meshes.get(name) or self._hull(name, markup)
        address = self._beside.add(file, data)
        if address is not None:
            for attribute in _TRIANGLES:
                markup.attributes.pop(attribute, None)
            markup.attributes["file"] = address

    def _hull(self, name: str, markup: Markup) -> tuple[str, bytes]:
        mesh = self._model.mesh(name)
        vertices = np.array(markup.attributes["vertex"].split(), dtype=np.float32).reshape(-1, 3)
        start, count = int(mesh.faceadr[0]), int(mesh.facenum[0])
        faces = self._model.mesh_face[start : start + count]
        plain = name.removeprefix("mesh ").replace("::", "_").replace("//", "_")
        return f"{plain}.obj", obj_bytes(vertices, faces)


def _rewritten(tag: Tag, make_mesh: Callable[[Markup], None]) -> Markup:
    """Return MuJoCo's XML with the shortest numbers, and meshes in files."""
    attributes = {
        name: value if name in _AS_IS else _shortest(value, is_single=name in _COLOURS)
        for name, value in tag.attributes.items()
    }
    children = [_rewritten(child, make_mesh) for child in tag.children]
    markup = Markup(tag.name, attributes, tag.text, children)
    if tag.name == "mesh" and "vertex" in attributes:
        make_mesh(markup)
    return markup


def _shortest(text: str, *, is_single: bool = False) -> str:
    tokens = text.split()
    if len(max(tokens, key=len, default="")) < 4:
        return text
    try:
        if is_single:
            tokens = [str(np.float32(token)) for token in tokens]
        return numbers(float(token) if not _is_whole(token) else int(token) for token in tokens)
    except ValueError:
        return text


def _is_whole(token: str) -> bool:
    return token.lstrip("+-").isdigit()


def _add_start(document: Markup, compiled: Compiled, world: World) -> None:
    """Append a keyframe with the positions that joints start at, if these are not the zeros."""
    data = initial_data(compiled.model, world)
    if np.array_equal(data.qpos, compiled.model.qpos0):
        return
    key = document.add("keyframe").add("key", name=_START)
    key.attributes["qpos"] = " ".join(number(float(value)) for value in data.qpos)


def _report_outside(world: World, found: Diagnostics) -> None:
    for model in world.models:
        things = _outside(model)
        if things:
            message = (
                f"what acts on '{model.name}' from outside MuJoCo is not in the file: "
                f"{', '.join(things)}"
            )
            found.report("convert.mjcf-outside", message, model.span)
    for joint in described_slips(world):
        message = (
            f"wheel '{joint}' slips in Gazelle by a device that acts between the steps; in the "
            "file it only has its friction"
        )
        found.report("convert.left-out", message)


def _outside(model: Model) -> list[str]:
    sensors = [sensor for link in model.links for sensor in link.sensors]
    sensors += [sensor for joint in model.joints for sensor in joint.sensors]
    counts = {
        "plug-in": len(model.plugins) + sum(len(item.plugins) for item in sensors),
        "sensor": len(sensors),
        "transmission": len(model.transmissions),
        "ros2_control block": len(model.ros2_controls),
        "light": sum(len(link.lights) for link in model.links),
    }
    return [f"{count} {name}{'s' * (count != 1)}" for name, count in counts.items() if count]
