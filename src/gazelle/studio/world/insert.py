"""New models: of the model paths, primitives, and files dropped on the page."""

from __future__ import annotations

import re
from typing import Any
from xml.sax.saxutils import escape

from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.world.models import model_folder
from gazelle.studio.world.world_control import WorldLink, pose_message, pose_of

__all__ = ["insert", "primitive_sdf"]

_MAX_TEXT = 16 << 20
_MASS_KG = 1.0
# Whoever places it farther away than this is refused by the world.
_MAX_M = 1e5
_PRIMITIVES = ("box", "cylinder", "sphere")
_NUMBER = re.compile(r"_(\d+)$")
_PLACE = re.compile(r"<[a-z_]+>(?=:\d+:\d+)")


def insert(world: WorldLink, params: Params) -> Any:
    """``world.insert``: puts a model into the world; returns the name that it has there."""
    source = Params("world.insert", params.object("source"))
    text, wanted = _text_of(source)
    names = world.call("get_world_properties", "gazebo_msgs/GetWorldProperties")
    name = _free_name(params.text("name", "") or wanted, set(names.model_names))
    service = "spawn_urdf_model" if _is_urdf(text) else "spawn_sdf_model"
    try:
        world.call(
            service,
            "gazebo_msgs/SpawnModel",
            model_name=name,
            model_xml=text,
            initial_pose=pose_message(pose_of(params)),
        )
    except StudioError as error:
        raise _in_file(error, source.text("file", "")) from error
    return {"name": name}


def primitive_sdf(kind: str, size: list[float]) -> str:
    """Return a model of one box, sphere or cylinder of 1 kg.

    Args:
        kind: ``box``, ``sphere`` or ``cylinder``.
        size: edges of a box; radius of a sphere; radius and length of a cylinder, metres.

    Raises:
        StudioError: there is no such shape, or its size is not positive.
    """
    if kind not in _PRIMITIVES:
        raise StudioError(f"there is no primitive '{kind}'", known=_PRIMITIVES)
    wanted = {"box": 3, "sphere": 1, "cylinder": 2}[kind]
    if len(size) != wanted or min(size) <= 0.0:
        raise StudioError(f"a {kind} has {wanted} sizes above 0, not {size}")
    if max(size) > _MAX_M:
        raise StudioError(f"a {kind}'s sizes are at most {_MAX_M:g} m, not {size}")
    elements = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length")}[kind]
    values = [" ".join(f"{one:g}" for one in size)] if kind == "box" else [f"{v:g}" for v in size]
    inside = "".join(
        f"<{name}>{value}</{name}>" for name, value in zip(elements, values, strict=True)
    )
    geometry = f"<geometry><{kind}>{inside}</{kind}></geometry>"
    xx, yy, zz = _moments(kind, size)
    return (
        f'<sdf version="1.6"><model name="{kind}"><link name="link"><inertial><mass>{_MASS_KG}'
        f"</mass><inertia><ixx>{xx:.9g}</ixx><ixy>0</ixy><ixz>0</ixz><iyy>{yy:.9g}</iyy><iyz>0"
        f'</iyz><izz>{zz:.9g}</izz></inertia></inertial><collision name="collision">{geometry}'
        f'</collision><visual name="visual">{geometry}<material><script><name>Gazebo/Grey</name>'
        "</script></material></visual></link></model></sdf>"
    )


def _moments(kind: str, size: list[float]) -> tuple[float, float, float]:
    """Closed forms of the uniform solids, kg·m²."""
    if kind == "box":
        x, y, z = (_MASS_KG * edge * edge / 12.0 for edge in size)
        return y + z, x + z, x + y
    if kind == "sphere":
        moment = 0.4 * _MASS_KG * size[0] ** 2
        return moment, moment, moment
    radius, length = size
    across = _MASS_KG * (3.0 * radius**2 + length**2) / 12.0
    return across, across, _MASS_KG * radius**2 / 2.0


def _text_of(source: Params) -> tuple[str, str]:
    """Return the model's text and the name that it would have."""
    if "model" in source:
        name = source.text("model")
        folder = model_folder(name)
        uri = escape(folder.as_uri())
        return f'<sdf version="1.6"><include><uri>{uri}</uri></include></sdf>', name
    if "primitive" in source:
        kind = source.text("primitive")
        default = {"box": [1.0] * 3, "sphere": [0.5], "cylinder": [0.5, 1.0]}.get(kind, [1.0])
        return primitive_sdf(kind, source.numbers("size", default)), f"unit_{kind}"
    text = source.text("text")
    if len(text) > _MAX_TEXT:
        raise StudioError(f"the file has more than {_MAX_TEXT >> 20} MiB")
    return text, _named(text, source.text("file", ""))


def _in_file(error: StudioError, file: str) -> StudioError:
    """Name the file that was dropped where the world only knows of a text."""
    text = str(error)
    return StudioError(_PLACE.sub(lambda _: file, text)) if file else error


def _named(text: str, file: str) -> str:
    diagnostics = Diagnostics()
    root = parse_xml(text, file or "dropped file", diagnostics)
    if root is None:
        raise StudioError("; ".join(f"{one.span}: {one.message}" for one in diagnostics))
    models = [tag for tag in (root, *root.children) if tag.name in ("model", "robot")]
    if not models:
        raise StudioError(
            f"the file's <{root.name}> holds no model",
            hint="drop a URDF or an SDF model; expand xacro files first, with 'gazelle xacro'",
        )
    return models[0].attributes.get("name") or "model"


def _is_urdf(text: str) -> bool:
    return re.search(r"<robot[\s>]", text) is not None


def _free_name(wanted: str, taken: set[str]) -> str:
    """Gazebo adds ``_0``, ``_1`` … to a name that is taken."""
    if wanted not in taken:
        return wanted
    stem = _NUMBER.sub("", wanted)
    numbered = (f"{stem}_{number}" for number in range(100_000))
    return next(name for name in numbered if name not in taken)
