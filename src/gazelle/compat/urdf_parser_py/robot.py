"""A robot of URDF with its links, joints and transmissions as Python objects."""

from __future__ import annotations

from typing import Any, ClassVar, Self

from gazelle.compat.urdf_parser_py.shapes import (
    Collision,
    Inertial,
    Material,
    Pose,
    Visual,
    name_attribute,
    origin_element,
)
from gazelle.compat.urdf_parser_py.value_types import (
    DuckTypedFactory,
    RawType,
    SimpleElementType,
    add_type,
    end_namespace,
    start_namespace,
)
from gazelle.compat.urdf_parser_py.xml_reflection import (
    AggregateElement,
    Attribute,
    Element,
    Object,
    Reflection,
)

__all__ = [
    "URDF",
    "Actuator",
    "Joint",
    "JointCalibration",
    "JointDynamics",
    "JointLimit",
    "JointMimic",
    "Link",
    "PR2Transmission",
    "Robot",
    "SafetyController",
    "Transmission",
    "TransmissionJoint",
]

start_namespace("urdf")
add_type("element_link", SimpleElementType("link", str))
add_type("element_xyz", SimpleElementType("xyz", "vector3"))


def _zeros(*names: str) -> list[Attribute]:
    return [Attribute(name, float, False, 0) for name in names]


class JointDynamics(Object):
    """``<dynamics>``."""

    XML_REFL = Reflection(
        [Attribute(name, float, False) for name in ("damping", "friction")], tag="dynamics"
    )

    def __init__(self, damping: float | None = None, friction: float | None = None) -> None:
        self.damping = damping
        self.friction = friction


class JointCalibration(Object):
    """``<calibration>``."""

    XML_REFL = Reflection(_zeros("rising", "falling"), tag="calibration")

    def __init__(self, rising: float | None = None, falling: float | None = None) -> None:
        self.rising = rising
        self.falling = falling


class JointLimit(Object):
    """``<limit>``."""

    XML_REFL = Reflection(
        [Attribute("effort", float), *_zeros("lower", "upper"), Attribute("velocity", float)],
        tag="limit",
    )

    def __init__(
        self,
        effort: float | None = None,
        velocity: float | None = None,
        lower: float | None = None,
        upper: float | None = None,
    ) -> None:
        self.effort = effort
        self.velocity = velocity
        self.lower = lower
        self.upper = upper


class JointMimic(Object):
    """``<mimic>``."""

    XML_REFL = Reflection(
        [
            Attribute("joint", str),
            Attribute("multiplier", float, False),
            Attribute("offset", float, False),
        ],
        tag="mimic",
    )

    def __init__(
        self,
        joint_name: str | None = None,
        multiplier: float | None = None,
        offset: float | None = None,
    ) -> None:
        self.joint = joint_name
        self.multiplier = multiplier
        self.offset = offset


class SafetyController(Object):
    """``<safety_controller>``."""

    XML_REFL = Reflection(
        [
            Attribute("k_velocity", float),
            *_zeros("k_position", "soft_lower_limit", "soft_upper_limit"),
        ],
        tag="safety_controller",
    )

    def __init__(
        self,
        velocity: float | None = None,
        position: float | None = None,
        lower: float | None = None,
        upper: float | None = None,
    ) -> None:
        self.k_velocity = velocity
        self.k_position = position
        self.soft_lower_limit = lower
        self.soft_upper_limit = upper


class Joint(Object):
    """``<joint>``; `parent` and `child` are names of links."""

    TYPES: ClassVar = [
        *("unknown", "revolute", "continuous", "prismatic", "floating", "planar", "fixed")
    ]
    XML_REFL = Reflection(
        [
            name_attribute,
            Attribute("type", str),
            origin_element,
            Element("axis", "element_xyz", False),
            Element("parent", "element_link"),
            Element("child", "element_link"),
            Element("limit", JointLimit, False),
            Element("dynamics", JointDynamics, False),
            Element("safety_controller", SafetyController, False),
            Element("calibration", JointCalibration, False),
            Element("mimic", JointMimic, False),
        ],
        tag="joint",
    )

    def __init__(  # noqa: PLR0913, PLR0917 - the original takes them by position
        self,
        name: str | None = None,
        parent: str | None = None,
        child: str | None = None,
        joint_type: str | None = None,
        axis: list[float] | None = None,
        origin: Pose | None = None,
        limit: JointLimit | None = None,
        dynamics: JointDynamics | None = None,
        safety_controller: SafetyController | None = None,
        calibration: JointCalibration | None = None,
        mimic: JointMimic | None = None,
    ) -> None:
        self.name = name
        self.parent = parent
        self.child = child
        self.type = joint_type
        self.axis = axis
        self.origin = origin
        self.limit = limit
        self.dynamics = dynamics
        self.safety_controller = safety_controller
        self.calibration = calibration
        self.mimic = mimic

    def check_valid(self) -> None:
        """Raise if URDF has no such type of joint."""
        assert self.type in self.TYPES, f"Invalid joint type: {self.type}"

    @property
    def joint_type(self) -> str | None:
        """`type`."""
        return self.type

    @joint_type.setter
    def joint_type(self, value: str | None) -> None:
        self.type = value


class Link(Object):
    """``<link>``; `visual` and `collision` are the first of `visuals` and `collisions`."""

    XML_REFL = Reflection(
        [
            name_attribute,
            origin_element,
            AggregateElement("visual", Visual),
            AggregateElement("collision", Collision),
            Element("inertial", Inertial, False),
        ],
        tag="link",
    )

    def __init__(
        self,
        name: str | None = None,
        visual: Visual | None = None,
        inertial: Inertial | None = None,
        collision: Collision | None = None,
        origin: Pose | None = None,
    ) -> None:
        self.aggregate_init()
        self.name = name
        self.inertial = inertial
        self.origin = origin
        self.visuals: list[Visual] = []
        self.collisions: list[Collision] = []
        self.visual = visual
        self.collision = collision

    @property
    def visual(self) -> Visual | None:
        """The first visual, None without any."""
        return self.visuals[0] if self.visuals else None

    @visual.setter
    def visual(self, visual: Visual | None) -> None:
        self._set_first("visual", visual)

    @property
    def collision(self) -> Collision | None:
        """The first collision, None without any."""
        return self.collisions[0] if self.collisions else None

    @collision.setter
    def collision(self, collision: Collision | None) -> None:
        self._set_first("collision", collision)

    def _set_first(self, tag: str, value: Any) -> None:
        """Put something in the first place of a list; None takes what is there away."""
        values = self.get_aggregate_list(tag)
        others = values[1:]
        for old in list(values):
            self.remove_aggregate(old)
        for one in [value, *others]:
            if one is not None:
                self.add_aggregate(tag, one)


class PR2Transmission(Object):
    """``<transmission>`` as the PR2's files have it: the type in an attribute."""

    XML_REFL = Reflection(
        [
            name_attribute,
            Attribute("type", str),
            Element("joint", "element_name"),
            Element("actuator", "element_name"),
            Element("mechanicalReduction", float),
        ],
        tag="pr2_transmission",
    )

    def __init__(
        self,
        name: str | None = None,
        joint: str | None = None,
        actuator: str | None = None,
        type: str | None = None,
        mechanicalReduction: float = 1,
    ) -> None:
        self.name = name
        self.joint = joint
        self.actuator = actuator
        self.type = type
        self.mechanicalReduction = mechanicalReduction


class Actuator(Object):
    """``<actuator>`` of a transmission."""

    XML_REFL = Reflection(
        [name_attribute, Element("mechanicalReduction", float, required=False)], tag="actuator"
    )

    def __init__(self, name: str | None = None, mechanicalReduction: float | None = 1) -> None:
        self.name = name
        self.mechanicalReduction = mechanicalReduction


class TransmissionJoint(Object):
    """``<joint>`` of a transmission."""

    XML_REFL = Reflection([name_attribute, AggregateElement("hardwareInterface", str)], tag="joint")

    def __init__(self, name: str | None = None) -> None:
        self.aggregate_init()
        self.name = name
        self.hardwareInterfaces: list[str] = []

    def check_valid(self) -> None:
        """Raise if it has no hardware interface."""
        assert self.hardwareInterfaces, "no hardwareInterface defined"


class Transmission(Object):
    """``<transmission>``."""

    XML_REFL = Reflection(
        [
            name_attribute,
            Element("type", str),
            AggregateElement("joint", TransmissionJoint),
            AggregateElement("actuator", Actuator),
        ],
        tag="new_transmission",
    )

    def __init__(self, name: str | None = None) -> None:
        self.aggregate_init()
        self.name = name
        self.type: str | None = None
        self.joints: list[TransmissionJoint] = []
        self.actuators: list[Actuator] = []

    def check_valid(self) -> None:
        """Raise if it has no joint or no actuator."""
        assert self.joints, "no joint defined"
        assert self.actuators, "no actuator defined"


add_type("transmission", DuckTypedFactory("transmission", [Transmission, PR2Transmission]))


class Robot(Object):
    """``<robot>``.

    Attributes:
        link_map: the links by their names, `joint_map` the joints by theirs.
        parent_map: by a link's name the names of the joint above it and of the link above that.
        child_map: by a link's name pairs of names: a joint below it, and the link below that.
    """

    SUPPORTED_VERSIONS: ClassVar = ["1.0"]
    XML_REFL = Reflection(
        [
            Attribute("name", str),
            Attribute("version", str, False),
            AggregateElement("link", Link),
            AggregateElement("joint", Joint),
            AggregateElement("gazebo", RawType()),
            AggregateElement("transmission", "transmission"),
            AggregateElement("material", Material),
        ],
        tag="robot",
    )

    def __init__(self, name: str | None = None, version: str = "1.0") -> None:
        self.aggregate_init()
        self.name = name
        self.version: str | None = version
        self._check_version(version)
        self.joints: list[Joint] = []
        self.links: list[Link] = []
        self.materials: list[Material] = []
        self.gazebos: list[Any] = []
        self.transmissions: list[Any] = []
        self.joint_map: dict[str | None, Joint] = {}
        self.link_map: dict[str | None, Link] = {}
        self.parent_map: dict[str | None, tuple[str | None, str | None]] = {}
        self.child_map: dict[str | None, list[tuple[str | None, str | None]]] = {}

    def _check_version(self, version: str) -> None:
        if version not in self.SUPPORTED_VERSIONS:
            known = ",".join(self.SUPPORTED_VERSIONS)
            raise ValueError(f"Invalid version; only {known} is supported")

    def add_aggregate(self, typeName: str, elem: Any) -> None:
        """Append a link, a joint or another part to its list, and to the maps."""
        super().add_aggregate(typeName, elem)
        if typeName == "link":
            self.link_map[elem.name] = elem
        elif typeName == "joint":
            self.joint_map[elem.name] = elem
            self.parent_map[elem.child] = (elem.name, elem.parent)
            self.child_map.setdefault(elem.parent, []).append((elem.name, elem.child))

    def add_link(self, link: Link) -> None:
        """Append a link."""
        self.add_aggregate("link", link)

    def add_joint(self, joint: Joint) -> None:
        """Append a joint."""
        self.add_aggregate("joint", joint)

    def get_chain(
        self, root: str, tip: str, joints: bool = True, links: bool = True, fixed: bool = True
    ) -> list[str | None]:
        """Return the names from one link down to another, of joints, links or both in turn.

        Args:
            root: the upper link.
            tip: the lower link.
            joints: name the joints.
            links: name the links.
            fixed: name fixed joints too.
        """
        chain: list[str | None] = [tip] if links else []
        link: str | None = tip
        while link != root:
            joint, link = self.parent_map[link]
            if joints and (fixed or self.joint_map[joint].type != "fixed"):
                chain.append(joint)
            if links:
                chain.append(link)
        return chain[::-1]

    def get_root(self) -> str | None:
        """Return the name of the one link that is no joint's child."""
        roots = [link for link in self.link_map if link not in self.parent_map]
        assert len(roots) < 2, "Multiple roots detected, invalid URDF."
        assert roots, "No roots detected, invalid URDF."
        return roots[0]

    def post_read_xml(self) -> None:
        """Raise if the file is of another version of URDF."""
        if self.version is None:
            self.version = "1.0"
        parts = self.version.split(".")
        if len(parts) != 2:
            raise ValueError("The version attribute should be in the form 'x.y'")
        if "" in parts:
            raise ValueError("Empty major or minor number is not allowed")
        if any(int(part) < 0 for part in parts):
            raise ValueError("Version number must be positive")
        self._check_version(self.version)

    @classmethod
    def from_parameter_server(cls, key: str = "robot_description") -> Self:
        """Return the robot that a parameter's text describes."""
        from gazelle.compat.rospy import get_param

        return cls.from_xml_string(str(get_param(key)))


URDF = Robot
end_namespace()
