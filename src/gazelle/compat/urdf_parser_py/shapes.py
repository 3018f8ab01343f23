"""What a URDF link is made of, as Python objects: places, shapes, materials and masses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar
from xml.etree import ElementTree as ET

from gazelle.compat.urdf_parser_py.value_types import (
    FactoryType,
    Path,
    ValueType,
    add_type,
    end_namespace,
    report,
    start_namespace,
)
from gazelle.compat.urdf_parser_py.xml_reflection import (
    Attribute,
    Element,
    Object,
    Param,
    Reflection,
)
from gazelle.compat.urdf_parser_py.xml_text import node_add, xml_children

__all__ = [
    "Box",
    "Collision",
    "Color",
    "Cylinder",
    "GeometricType",
    "Inertia",
    "Inertial",
    "LinkMaterial",
    "Material",
    "Mesh",
    "Pose",
    "Sphere",
    "Texture",
    "Visual",
    "name_attribute",
    "origin_element",
]

Vector = Sequence[float]
start_namespace("urdf")
name_attribute = Attribute("name", str)


class Pose(Object):
    """``<origin>``: `xyz` (`position`) in metres and `rpy` (`rotation`) in radians."""

    XML_REFL = Reflection(
        [Attribute(one, "vector3", False, default=[0, 0, 0]) for one in ("xyz", "rpy")],
        tag="origin",
    )

    def __init__(self, xyz: Vector | None = None, rpy: Vector | None = None) -> None:
        self.xyz = xyz
        self.rpy = rpy

    def check_valid(self) -> None:
        """Raise if it is not three numbers each."""
        assert all(one is None or len(one) == 3 for one in (self.xyz, self.rpy))

    @property
    def rotation(self) -> Vector | None:
        """`rpy`."""
        return self.rpy

    @rotation.setter
    def rotation(self, value: Vector | None) -> None:
        self.rpy = value

    @property
    def position(self) -> Vector | None:
        """`xyz`."""
        return self.xyz

    @position.setter
    def position(self, value: Vector | None) -> None:
        self.xyz = value


origin_element = Element("origin", Pose, False)


class Color(Object):
    """``<color>``: `rgba`, of four numbers, three, or one list of them."""

    XML_REFL = Reflection([Attribute("rgba", "vector4")], tag="color")

    def __init__(self, *args: Any) -> None:
        numbers = list(args[0] if len(args) == 1 else args)
        if len(numbers) not in (0, 3, 4):
            raise Exception("Invalid color argument count")
        self.rgba = [*numbers, 1.0][:4] if numbers else None


class Box(Object):
    """``<box>``."""

    XML_REFL = Reflection([Attribute("size", "vector3")], tag="box")

    def __init__(self, size: Vector | None = None) -> None:
        self.size = size


class Cylinder(Object):
    """``<cylinder>``."""

    XML_REFL = Reflection([Attribute("radius", float), Attribute("length", float)], tag="cylinder")

    def __init__(self, radius: float = 0.0, length: float = 0.0) -> None:
        self.radius = radius
        self.length = length


class Sphere(Object):
    """``<sphere>``."""

    XML_REFL = Reflection([Attribute("radius", float)], tag="sphere")

    def __init__(self, radius: float = 0.0) -> None:
        self.radius = radius


class Mesh(Object):
    """``<mesh>``."""

    XML_REFL = Reflection(
        [Attribute("filename", str), Attribute("scale", "vector3", required=False)], tag="mesh"
    )

    def __init__(self, filename: str | None = None, scale: Vector | None = None) -> None:
        self.filename = filename
        self.scale = scale


class GeometricType(ValueType):
    """``<geometry>``: the one shape in it."""

    def __init__(self) -> None:
        shapes = {"box": Box, "cylinder": Cylinder, "sphere": Sphere, "mesh": Mesh}
        self.factory = FactoryType("geometric", shapes)

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Return the shape."""
        children = xml_children(node)
        assert len(children) == 1, "One element only for geometric"
        return self.factory.from_xml(children[0], path)

    def write_xml(self, node: ET.Element, obj: Any) -> None:
        """Write the shape into ``<geometry>``."""
        child = node_add(node, self.factory.get_name(obj))
        assert child is not None
        obj.write_xml(child)


add_type("geometric", GeometricType())
_GEOMETRY: tuple[Param, ...] = (
    Attribute("name", str, False),
    origin_element,
    Element("geometry", "geometric"),
)


class Collision(Object):
    """``<collision>``."""

    XML_REFL = Reflection(_GEOMETRY, tag="collision")

    def __init__(
        self, geometry: Any = None, origin: Pose | None = None, name: str | None = None
    ) -> None:
        self.geometry = geometry
        self.origin = origin
        self.name = name


class Texture(Object):
    """``<texture>``."""

    XML_REFL = Reflection([Attribute("filename", str)], tag="texture")

    def __init__(self, filename: str | None = None) -> None:
        self.filename = filename


class Material(Object):
    """``<material>`` of a robot."""

    XML_REFL = Reflection(
        [name_attribute, Element("color", Color, False), Element("texture", Texture, False)],
        tag="material",
    )

    def __init__(
        self, name: str | None = None, color: Color | None = None, texture: Texture | None = None
    ) -> None:
        self.name = name
        self.color = color
        self.texture = texture

    def check_valid(self) -> None:
        """Tell if it says neither a colour nor a texture."""
        if self.color is None and self.texture is None:
            report("Material has neither a color nor texture.", "urdf_parser_py.xml_reflection")


class LinkMaterial(Material):
    """``<material>`` of a visual, which may be a name alone."""

    def check_valid(self) -> None:
        """Take it as it is."""


class Visual(Object):
    """``<visual>``."""

    XML_REFL = Reflection([*_GEOMETRY, Element("material", LinkMaterial, False)], tag="visual")

    def __init__(
        self,
        geometry: Any = None,
        material: Material | None = None,
        origin: Pose | None = None,
        name: str | None = None,
    ) -> None:
        self.geometry = geometry
        self.material = material
        self.origin = origin
        self.name = name


class Inertia(Object):
    """``<inertia>``, in kg m²."""

    KEYS: ClassVar = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
    XML_REFL = Reflection(
        [Attribute(key, float) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")],
        tag="inertia",
    )

    def __init__(
        self,
        ixx: float = 0.0,
        ixy: float = 0.0,
        ixz: float = 0.0,
        iyy: float = 0.0,
        iyz: float = 0.0,
        izz: float = 0.0,
    ) -> None:
        self.ixx, self.ixy, self.ixz = ixx, ixy, ixz
        self.iyy, self.iyz, self.izz = iyy, iyz, izz

    def to_matrix(self) -> list[list[float]]:
        """Return the three rows."""
        return [
            [self.ixx, self.ixy, self.ixz],
            [self.ixy, self.iyy, self.iyz],
            [self.ixz, self.iyz, self.izz],
        ]


class Inertial(Object):
    """``<inertial>``: `mass` in kg."""

    XML_REFL = Reflection(
        [origin_element, Element("mass", "element_value"), Element("inertia", Inertia, False)],
        tag="inertial",
    )

    def __init__(
        self, mass: float = 0.0, inertia: Inertia | None = None, origin: Pose | None = None
    ) -> None:
        self.mass = mass
        self.inertia = inertia
        self.origin = origin


end_namespace()
