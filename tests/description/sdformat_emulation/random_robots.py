"""Robot descriptions made at random, with everything that sdformat's conversion looks at."""

from __future__ import annotations

import random
from collections.abc import Callable
from xml.sax.saxutils import quoteattr

__all__ = ["random_robot"]

_NAMES = ("base", "base_plate", "arm", "arm_2", "a", "wheel", "camera_link", "laser", "palm", "b")
_NUMBERS = ("0", "-0", "1", "0.1", "-0.25", ".5", "1.", "+2", "1e-3", "-1E-7", "0.123456789", "3.5")
_ANGLES = ("0", "1.5707963267948966", "-1.5707963267948966", "3.141592653589793", "0.1", "-2.5")
_ODD_ANGLES = ("1.5707", "-1.5708", "1.57079632", "1e-9", "6.283", "0.7853981633974483")
_WORDS = ("true", "false", "True", "YES", "no", "1", "0", " true ", "TRUE", "on", "")
_NUMBER_KEYS = (
    "dampingFactor",
    "maxVel",
    "minDepth",
    "mu1",
    "mu2",
    "kp",
    "kd",
    "laserRetro",
    "springReference",
    "springStiffness",
    "stopCfm",
    "stopErp",
    "fudgeFactor",
)
_WORD_KEYS = (
    "turnGravityOff",
    "selfCollide",
    "static",
    "provideFeedback",
    "implicitSpringDamper",
    "cfmDamping",
    "gravity",
    "preserveFixedJoint",
    "disableFixedJointLumping",
)


class _Maker:
    """One description in the making."""

    def __init__(self, seed: int) -> None:
        self.dice = random.Random(seed)
        count = self.dice.choice((1, 2, 3, 4, 5, 6, 8))
        self.links = self.dice.sample(_NAMES, count)
        if self.dice.random() < 0.15:
            self.links[self.dice.choice((0, 0, len(self.links) - 1))] = "world"
        self.joints: list[str] = []

    def chance(self, share: float) -> bool:
        return self.dice.random() < share

    def number(self) -> str:
        if self.chance(0.6):
            return self.dice.choice(_NUMBERS)
        return (
            repr(self.dice.uniform(-2, 2)) if self.chance(0.7) else f"{self.dice.gauss(0, 9):.4f}"
        )

    def vector(self) -> str:
        gap = self.dice.choice((" ", " ", "  "))
        return gap.join(self.number() for _ in range(3))

    def angles(self) -> str:
        kinds = (_ANGLES, _ANGLES, _ODD_ANGLES)
        words = (self.dice.choice(self.dice.choice(kinds)) for _ in range(3))
        if self.chance(0.3):
            words = (repr(self.dice.uniform(-3.2, 3.2)) for _ in range(3))
        return " ".join(words)

    def origin(self) -> str:
        if self.chance(0.3):
            return ""
        xyz = f' xyz="{self.vector()}"' if self.chance(0.9) else ""
        rpy = f' rpy="{self.angles()}"' if self.chance(0.7) else ""
        return f"<origin{xyz}{rpy}/>"

    def text(self) -> str:
        parts = [self.material(True) for _ in range(self.dice.choice((0, 0, 1, 2)))]
        parts = list(dict.fromkeys(parts))
        names = [name.split('"')[1] for name in parts]
        parts = parts if len(set(names)) == len(names) else parts[:1]
        parts += [self.origin()] if self.chance(0.1) else []
        parts += [self.link(name) for name in self.links]
        parts += [self.joint(index) for index in range(1, len(self.links))]
        parts += [self.gazebo() for _ in range(self.dice.choice((0, 1, 3, 6, 10)))]
        name = self.dice.choice(("robot", "my robot", 'r"1"', "r&b"))
        return f"<robot name={quoteattr(name)}>\n" + "\n".join(parts) + "\n</robot>\n"

    def material(self, is_defined: bool) -> str:
        name = self.dice.choice(("red", "blue", "Gazebo/Grey", "m"))
        inside = self.dice.choice(
            (
                '<color rgba="0.7 0.2 1 0.5"/>',
                '<color rgba="0 0.05 .9  1"/>',
                '<color rgba="0.1 0.2 0.3"/>',
                '<texture filename="package://p/t.png"/>',
                '<color rgba="2 0 0 1"/>',
            )
        )
        return (
            f'<material name="{name}">{inside if is_defined or self.chance(0.5) else ""}</material>'
        )

    def link(self, name: str) -> str:
        parts = [self.inertial()] if self.chance(0.8) else []
        for kind in ("visual", "collision"):
            for _ in range(self.dice.choice((0, 1, 1, 1, 2, 3))):
                parts.append(self.part(kind, name))
        self.dice.shuffle(parts)
        return f'<link name="{name}">{"".join(parts)}</link>'

    def inertial(self) -> str:
        mass = self.dice.choice(("1", "0.5", "2.25", "10", "0.1", "0.0123456789012345678"))
        if self.chance(0.15):
            mass = self.dice.choice(("0", "-1", "1e-7", "1e-6", "1.1e-6", "bad"))
        words = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        values = [f'{word}="{self.number()}"' for word in words]
        values = values[: 5 if self.chance(0.03) else 6]
        inertia = f"<inertia {' '.join(values)}/>"
        return f'<inertial>{self.origin()}<mass value="{mass}"/>{inertia}</inertial>'

    def part(self, kind: str, link: str) -> str:
        names = ("", "", "", link, "part", f"{link}_{kind}", "a_fixed_joint_lump__b")
        name = self.dice.choice(names)
        attribute = f' name="{name}"' if name else ""
        material = self.material(False) if kind == "visual" and self.chance(0.5) else ""
        geometry = f"<geometry>{self.shape()}</geometry>" if self.chance(0.98) else ""
        return f"<{kind}{attribute}>{self.origin()}{geometry}{material}</{kind}>"

    def shape(self) -> str:
        scale = self.dice.choice(("", ' scale="0.001 0.001 0.0012345678"', ' scale="-1 1 -0"'))
        uri = self.dice.choice(
            ("package://p/m/a.stl", "file:///m/b.dae", "c.obj", "model://x/y.dae")
        )
        return self.dice.choice(
            (
                f'<box size="{self.vector()}"/>',
                f'<cylinder radius="{self.number()}" length="{self.number()}"/>',
                f'<sphere radius="{self.number()}"/>',
                f'<mesh filename="{uri}"{scale}/>',
            )
        )

    def joint(self, index: int) -> str:
        kinds = (
            "fixed",
            "fixed",
            "fixed",
            "revolute",
            "continuous",
            "prismatic",
            "floating",
            "planar",
        )
        kind = self.dice.choice(kinds)
        child = self.links[index]
        parent = self.links[self.dice.randrange(index)]
        name = f"{self.dice.choice('zyxcba')}_{child}_joint"
        self.joints.append(name)
        ends = f'<parent link="{parent}"/><child link="{child}"/>'
        more = [self.origin()]
        if kind in ("revolute", "prismatic") or self.chance(0.4):
            bounds = f'lower="{self.number()}" upper="{self.number()}"' if self.chance(0.9) else ""
            more.append(f'<limit {bounds} effort="{self.number()}" velocity="1.5"/>')
        if self.chance(0.5):
            more.append(
                self.dice.choice(
                    (f'<axis xyz="{self.vector()}"/>', '<axis xyz="0 0 1"/>', "<axis/>")
                )
            )
        if self.chance(0.4):
            more.append(
                self.dice.choice(('<dynamics damping="0.7"/>', '<dynamics friction="1e-5"/>'))
            )
        if self.joints[:-1] and self.chance(0.2):
            more.append(f'<mimic joint="{self.joints[0]}" multiplier="2"/>')
        if self.chance(0.1):
            more.append('<safety_controller k_velocity="3" k_position="1"/>')
        return f'<joint name="{name}" type="{kind}">{ends}{"".join(more)}</joint>'

    def gazebo(self) -> str:
        reference = self.dice.choice(
            (*self.links, *self.links, *self.joints, *self.joints, "", "none")
        )
        makers: tuple[Callable[[], str], ...] = (self.number_key, self.word_key, self.other_key)
        if reference not in self.joints:
            makers += (self.blob, self.blob, self.part_blob)
        inside = "".join(self.dice.choice(makers)() for _ in range(self.dice.choice((0, 1, 2, 4))))
        attribute = f' reference="{reference}"' if reference else ""
        return f"<gazebo{attribute}>{inside}</gazebo>"

    def key(self, name: str, value: str) -> str:
        if self.chance(0.2):
            return f'<{name} value="{value}"/>'
        return f"<{name}>{value}</{name}>"

    def number_key(self) -> str:
        value = self.number()
        if self.chance(0.1):
            value = self.dice.choice((f" {value} ", f"{value}abc", "1e5 2", "0x1A", "inf"))
        if self.chance(0.004):
            value = self.dice.choice(("", "abc", "1e999", "1e-320"))
        return self.key(self.dice.choice(_NUMBER_KEYS), value)

    def word_key(self) -> str:
        return self.key(self.dice.choice(_WORD_KEYS), self.dice.choice(_WORDS))

    def other_key(self) -> str:
        return self.dice.choice(
            (
                "<material>Gazebo/Red</material>",
                "<material>Gazebo/Blue</material>",
                '<material value="Gazebo/Black"/>',
                "<fdir1>1 0 0</fdir1>",
                "<fdir1> 0 1 0</fdir1>",
                "<maxContacts>5</maxContacts>",
                "<maxContacts>7.9</maxContacts>",
                "<canonicalBody>base</canonicalBody>",
                "<!-- nothing -->",
            )
        )

    def blob(self) -> str:
        name = self.dice.choice(self.links)
        makers = (self.sensor, self.plugin, self.named, self.named, lambda _: self.placed())
        return self.dice.choice(makers)(name)

    def pose(self) -> str:
        if self.chance(0.1):
            odd = ("<pose/>", "<pose>1 2</pose>", '<pose relative_to="x">1 0 0 0 0 0</pose>')
            return self.dice.choice(odd)
        random_one = f"<pose>{self.vector()} {self.angles()}</pose>"
        return self.dice.choice(("", random_one, "<pose>1 2 3 0 0 0.5</pose>"))

    def sensor(self, link: str) -> str:
        plugin = f"<plugin name='q' filename='libq.so'><frameName>{link}</frameName></plugin>"
        inside = self.pose() + self.dice.choice(("", plugin)) + "<update_rate>5</update_rate>"
        return f"<sensor name='s{self.dice.randrange(99)}' type='imu'>{inside}</sensor>"

    def plugin(self, link: str) -> str:
        offsets = self.dice.choice(
            (
                "",
                f"<xyzOffset>{self.vector()}</xyzOffset>",
                f"<xyzOffset>{self.vector()}</xyzOffset><rpyOffset>{self.angles()}</rpyOffset>",
                "<rpyOffset>0 0 x</rpyOffset>",
                "<ignition::corrected_offsets>1</ignition::corrected_offsets>",
            )
        )
        inside = self.dice.choice(
            (
                f"<bodyName>{link}</bodyName>{offsets}",
                f"{offsets}<frameName> {link} </frameName><bodyName>{link}</bodyName>",
                f"<a b='1 2'>  some\n  text </a><a/><projector>{link}/p</projector>",
            )
        )
        return f"<plugin name='p{self.dice.randrange(99)}' filename='libp.so'>{inside}</plugin>"

    def named(self, link: str) -> str:
        contact = f"<contact><collision>{link}_collision</collision></contact>"
        palm = f"<gripper_link>{link}</gripper_link><palm_link>{link}</palm_link>"
        ends = f"<parent>{link}</parent><child>{self.links[0]}</child>"
        return self.dice.choice(
            (
                f"<sensor name='c' type='contact'>{contact}</sensor>",
                f"<gripper name='g'>{palm}</gripper>",
                f"<joint name='j' type='revolute'>{ends}<axis><xyz>0 0 1</xyz></axis></joint>",
            )
        )

    def placed(self) -> str:
        projection = "<fov>1</fov><near_clip>0.1</near_clip><far_clip>10</far_clip>"
        return self.dice.choice(
            (
                f"<projector name='r'>{self.pose()}<texture>t</texture>{projection}</projector>",
                f"<light name='l' type='point'>{self.pose()}</light>",
                "<unknown_thing attribute='1'><inner>2</inner></unknown_thing>",
                f"<pose>{self.vector()} {self.angles()}</pose>",
                "<enable_wind>true</enable_wind>",
            )
        )

    def part_blob(self) -> str:
        return self.dice.choice(
            (
                "<collision><surface><friction><ode><mu>0.3</mu><slip1>0.1</slip1></ode></friction>"
                "</surface></collision>",
                "<collision><surface><contact><ode><kp>5</kp></ode></contact></surface>"
                "<max_contacts>3</max_contacts></collision>",
                "<collision><laser_retro>4</laser_retro></collision>",
                "<visual><material><ambient>1 0 0 1</ambient></material></visual>",
                "<visual><material><script><name>X</name><uri>u</uri></script></material>"
                "<transparency>0.5</transparency></visual>",
                "<visual><material><emissive>0 1 0 1</emissive></material></visual>",
                "<visual><cast_shadows>false</cast_shadows></visual>",
                "<visual/>",
            )
        )


def random_robot(seed: int) -> str:
    """Return the URDF that belongs to a number; the same on every machine."""
    return _Maker(seed).text()
