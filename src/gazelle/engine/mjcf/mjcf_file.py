"""An MJCF file: its elements with their places, and what MuJoCo compiles of them.

Our own reader comes first, for places and for what is missing.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.writers.unscoped_names import free_name
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.engine.mujoco_library import compiled, drained_warnings, keep_warnings, mujoco
from gazelle.geometry import Pose

__all__ = ["CompiledMjcf", "MjcfSource", "compiled_mjcf", "is_mjcf", "pose_from", "read_source"]


_ASSET_FOLDERS = {
    "hfield": "meshdir",
    "mesh": "meshdir",
    "skin": "meshdir",
    "texture": "texturedir",
}


_SPANNED = ("body", "geom", "joint", "freejoint", "site", "camera")
_FOLDERS = {"mesh": "meshdir", "texture": "texturedir"}


def compiled_mjcf(path: Path, diagnostics: Diagnostics) -> CompiledMjcf | None:
    """Read and compile a file; None (reported) when that is impossible."""
    source = read_source(path, diagnostics)
    if source is None:
        return None
    try:
        with keep_warnings():
            spec = mujoco.MjSpec.from_file(str(path))
        # Both take things out of the model that a converted file shall have.
        spec.compiler.fusestatic = False
        spec.compiler.discardvisual = False
        model = compiled(spec)
    except (ValueError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        text = " ".join(str(error).split())
        message = f"MuJoCo refuses the file: {text}"
        diagnostics.report("convert.mjcf", message, source.root.span)
        return None
    for warning in drained_warnings():
        message = f"MuJoCo warns: {' '.join(warning.split())}"
        diagnostics.report("engine.mujoco-warning", message, source.root.span)
    return CompiledMjcf(spec, model, source)


class CompiledMjcf:
    """What MuJoCo makes of a file.

    Attributes:
        spec: MuJoCo's spec.
        model: MuJoCo's model.
        data: its data with every hinge and slide at 0 and everything else where it starts.
        source: the file with its places.
        bodies: name of each body.
        joints: name of each joint; different from all names of bodies.
        renamed: names of joints that had to be changed, old and new.
    """

    def __init__(self, spec: Any, model: Any, source: MjcfSource) -> None:
        self.spec = spec
        self.model = model
        self.source = source
        self.data = mujoco.MjData(model)
        kinds = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
        for index in range(model.njnt):
            if int(model.jnt_type[index]) in kinds:
                self.data.qpos[model.jnt_qposadr[index]] = 0.0
        mujoco.mj_kinematics(model, self.data)
        self.bodies = _names([model.body(i).name for i in range(model.nbody)], "body", frozenset())
        own = [model.joint(i).name for i in range(model.njnt)]
        self.joints = _names(own, "joint", frozenset(self.bodies))
        self.renamed = [
            (old, new) for old, new in zip(own, self.joints, strict=True) if old and old != new
        ]

    def body_pose(self, body: int) -> Pose:
        """Return where a body is in the world."""
        return pose_from(self.data.xpos[body], self.data.xquat[body])

    def tree(self, root: int) -> NDArray[np.intp]:
        """Return a body that hangs on the world and all below it, (n,) of MuJoCo's numbers."""
        return np.flatnonzero(self.model.body_rootid == root)

    def joints_of(self, body: int) -> range:
        """Return a body's joints, the outermost first."""
        start = int(self.model.body_jntadr[body])
        return range(start, start + int(self.model.body_jntnum[body])) if start >= 0 else range(0)

    def file_of(self, kind: str, element: Any) -> Path | None:
        """Return the file of a spec's mesh or texture; None when it has none."""
        if not element.file:
            return None
        folder = getattr(self.spec, _FOLDERS[kind]) or ""
        name = Path(element.file).name if self.spec.strippath else element.file
        base = self.source.path.parent
        found = [path for path in (base / folder / name, base / name) if path.is_file()]
        return found[0].resolve() if found else None


def pose_from(position: NDArray[np.float64], quat_wxyz: NDArray[np.float64]) -> Pose:
    """Return a pose from MuJoCo's numbers: a position (3,), m, and a quaternion (4,), wxyz."""
    x, y, z = (float(value) for value in position)
    qw, qx, qy, qz = (float(value) for value in quat_wxyz)
    return Pose((x, y, z), (qx, qy, qz, qw))


def read_source(path: Path, diagnostics: Diagnostics) -> MjcfSource | None:
    """Read a file and what it includes; None when a part of it cannot be had (reported).

    Entities are refused, every missing file is named at its place.
    """
    root = read_xml(path, diagnostics)
    if root is None:
        return None
    source = MjcfSource(path, root)
    _gather(root, path.parent, source, diagnostics, (path.resolve(),))
    _check_assets(source, diagnostics)
    for tag in source.tags:
        if tag.name in _SPANNED and "name" in tag.attributes:
            kind = "joint" if tag.name == "freejoint" else tag.name
            source.spans[kind, tag.attributes["name"]] = tag.span
    return None if diagnostics.errors else source


@dataclass(slots=True)
class MjcfSource:
    """An MJCF's elements with all it includes.

    Attributes:
        path: the file.
        root: its outermost element.
        spans: place of every named element, by element name and name.
        tags: all elements, included files' too, in document order.
    """

    path: Path
    root: Tag
    spans: dict[tuple[str, str], SourceSpan] = field(default_factory=dict)
    tags: list[Tag] = field(default_factory=list)

    def span(self, kind: str, name: str) -> SourceSpan:
        """Return where an element is written; the file's root for those without a name."""
        return self.spans.get((kind, name), self.root.span)

    def all_of(self, name: str) -> list[Tag]:
        """Return all elements of a name."""
        return [tag for tag in self.tags if tag.name == name]


def is_mjcf(path: Path) -> bool:
    """Tell whether a file's outermost element is ``<mujoco>``."""
    root = read_xml(path, Diagnostics()) if path.is_file() else None
    return root is not None and root.name == "mujoco"


def _gather(
    tag: Tag,
    folder: Path,
    source: MjcfSource,
    diagnostics: Diagnostics,
    chain: tuple[Path, ...],
) -> None:
    if tag.name != "include":
        source.tags.append(tag)
        for child in tag.children:
            _gather(child, folder, source, diagnostics, chain)
        return
    name = tag.attributes.get("file", "")
    file = folder / name
    if file.resolve() in chain:
        message = f"'{name}' includes itself"
        diagnostics.report("convert.mjcf", message, tag.span)
        return
    if not file.is_file():
        message = f"the included file '{file}' does not exist"
        diagnostics.report("convert.mjcf", message, tag.span, fix="correct the path")
        return
    root = read_xml(file, diagnostics)
    for child in root.children if root is not None else ():
        _gather(child, folder, source, diagnostics, (*chain, file.resolve()))


def _check_assets(source: MjcfSource, diagnostics: Diagnostics) -> None:
    folders = {"assetdir": "", "meshdir": "", "texturedir": ""}
    for tag in source.all_of("compiler"):
        folders |= {key: tag.attributes[key] for key in folders if key in tag.attributes}
    for tag in source.tags:
        name = tag.attributes.get("file")
        if tag.name not in _ASSET_FOLDERS or not name:
            continue
        own = folders[_ASSET_FOLDERS[tag.name]] or folders["assetdir"]
        file = source.path.parent / own / name
        if not file.is_file() and not (source.path.parent / name).is_file():
            message = f"the {tag.name} file '{file}' does not exist"
            diagnostics.report("convert.mjcf", message, tag.span, fix="correct the path")


def _names(own: list[str], word: str, others: frozenset[str]) -> tuple[str, ...]:
    """Return a name for each element: its own, or one with a number for those without."""
    found: list[str] = []
    taken = {*others, *own}
    for index, name in enumerate(own):
        if name and name not in others:
            found.append(name)
            continue
        found.append(free_name(f"{name}_joint" if name else f"{word}_{index}", taken))
        taken.add(found[-1])
    return tuple(found)
