"""Files that packages of both versions of ROS have, as texts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from gazelle.documents.yaml import MESSAGE_STYLE, dump_yaml
from gazelle.motion.setup_assistant.config import ControllerChoice, SetupAssistantConfig

__all__ = [
    "cartesian_limits_yaml",
    "description_of",
    "filled",
    "fixed_frame",
    "fixed_world_joint",
    "joint_limits_yaml",
    "kinematics_yaml",
    "moveit_controller",
    "package_xml",
    "rviz_view",
    "sensors_yaml",
    "setup_assistant_file",
    "yaml_text",
]

_TEMPLATES = Path(__file__).parent / "templates"


def filled(template: str, **words: str) -> str:
    """Return a template's text with words put in for ``@name@``."""
    text = (_TEMPLATES / f"{template}.in").read_text(encoding="utf-8")
    for name, value in words.items():
        text = text.replace(f"@{name}@", value)
    return text


def yaml_text(value: Mapping[str, Any], *comments: str) -> str:
    """Return a mapping as YAML below comments, its keys in order."""
    head = "".join(f"# {line}\n" for line in comments)
    return head + dump_yaml(_plain(value), MESSAGE_STYLE)


def description_of(config: SetupAssistantConfig) -> str:
    """Return the sentence for ``package.xml``."""
    return config.description or f"What MoveIt needs to know of the robot {config.robot_name}."


def package_xml(config: SetupAssistantConfig, template: str, depends: tuple[str, ...]) -> str:
    """Return ``package.xml``.

    Args:
        config: what was chosen.
        template: of it.
        depends: packages that the package runs with.
    """
    names = sorted({*depends, config.robot_package} - {config.package_name})
    return filled(
        template,
        package=config.package_name,
        description=escape(description_of(config)),
        author=escape(config.author.name),
        email=escape(config.author.email),
        depends="\n".join(f"  <exec_depend>{name}</exec_depend>" for name in names),
    )


def kinematics_yaml(config: SetupAssistantConfig) -> str:
    """Return ``kinematics.yaml``."""
    tree = {
        group: {
            "kinematics_solver": choice.solver,
            "kinematics_solver_search_resolution": choice.search_resolution,
            "kinematics_solver_timeout": choice.timeout_s,
            **({"position_only_ik": True} if choice.position_only else {}),
            **choice.others,
        }
        for group, choice in config.kinematics.items()
    }
    return yaml_text(tree) if tree else ""


def joint_limits_yaml(config: SetupAssistantConfig) -> str:
    """Return ``joint_limits.yaml``."""
    limits = {
        joint: {
            "has_velocity_limits": choice.has_velocity_limits,
            "max_velocity": choice.max_velocity,
            "has_acceleration_limits": choice.has_acceleration_limits,
            "max_acceleration": choice.max_acceleration,
            **choice.others,
        }
        for joint, choice in config.joint_limits.items()
    }
    tree = {
        "default_velocity_scaling_factor": config.velocity_scaling,
        "default_acceleration_scaling_factor": config.acceleration_scaling,
        "joint_limits": limits,
    }
    return yaml_text(
        tree,
        "Limits that take the place of the URDF's: rad or m, and per s and s^2.",
        "The factors are the share of them that is used unless a request says more, up to 1.0.",
    )


def cartesian_limits_yaml(config: SetupAssistantConfig) -> str:
    """Return limits of the tip for Pilz' planner."""
    limits = config.cartesian_limits
    tree = {item.name: getattr(limits, item.name) for item in fields(limits)}
    return yaml_text({"cartesian_limits": tree}, "Limits of the tip, for Pilz' planner.")


def sensors_yaml(config: SetupAssistantConfig) -> str:
    """Return ``sensors_3d.yaml``, of the octomap's sensors."""
    names = [f"sensor_{number}" for number in range(1, len(config.sensors) + 1)]
    if config.ros_version == 1:
        return yaml_text({"sensors": [dict(sensor) for sensor in config.sensors]})
    sensors = {name: dict(row) for name, row in zip(names, config.sensors, strict=True)}
    return yaml_text({"sensors": names, **sensors})


def moveit_controller(controller: ControllerChoice) -> dict[str, Any]:
    """Return a controller's entry for MoveIt, without its name."""
    return {
        "type": controller.type,
        "action_ns": controller.action_ns,
        "default": controller.default,
        "joints": list(controller.joints),
        **controller.others,
    }


def fixed_frame(config: SetupAssistantConfig) -> str:
    """Return the frame that RViz shows everything in."""
    virtual = config.srdf.virtual_joints
    if virtual:
        return virtual[0].parent_frame
    chains = [chain.base_link for group in config.srdf.groups for chain in group.chains]
    return chains[0] if chains else "world"


def fixed_world_joint(config: SetupAssistantConfig, indent: str) -> list[str]:
    """Return lines that fix the robot's root in Gazebo where a virtual joint does for MoveIt.

    It is within ``<gazebo>``, so that the URDF's root stays the link that the SRDF names.
    """
    found = [joint for joint in config.srdf.virtual_joints if joint.type == "fixed"]
    if not found:
        return []
    lines = [
        "<gazebo>",
        f'  <joint name="{found[0].name}" type="fixed">',
        "    <parent>world</parent>",
        f"    <child>{found[0].child_link}</child>",
        "  </joint>",
        "</gazebo>",
    ]
    return [indent + line for line in lines]


def rviz_view(config: SetupAssistantConfig) -> str:
    """Return RViz' view with the motion planning display."""
    groups = [*config.kinematics, *(group.name for group in config.srdf.groups), "arm"]
    template = f"ros{config.ros_version}/moveit.rviz"
    return filled(template, group=groups[0], frame=fixed_frame(config))


def setup_assistant_file(config: SetupAssistantConfig, written: Mapping[str, str]) -> str:
    """Return ``.setup_assistant``.

    Args:
        config: what was chosen.
        written: digests of the package's files as they are written, by path: what differs later
            was edited by hand.
    """
    source = config.source
    urdf = {"package": config.robot_package, "relative_path": source.relative_path}
    if source.xacro_args:
        urdf["xacro_args"] = source.xacro_args
    names = ("URDF", "SRDF", "CONFIG") if config.ros_version == 1 else _ROS2_NAMES
    author = {"author_name": config.author.name, "author_email": config.author.email}
    tree: dict[str, Any] = {
        names[0]: urdf,
        names[1]: {"relative_path": config.srdf_file},
        names[2]: author,
    }
    if config.ros_version == 2 and config.adds_hardware:
        commands = sorted({kind for kinds in config.command_interfaces.values() for kind in kinds})
        tree["modified_urdf"] = {"xacros": ["control_xacro"]}
        tree["control_xacro"] = {"command": commands, "state": list(config.state_interfaces)}
    tree["gazelle"] = {
        "collision_trials": config.collision_trials,
        "always_fraction": config.always_fraction,
        # A package of ROS 2 has a file for them.
        **({"initial_positions": config.initial_positions} if config.ros_version == 1 else {}),
        "files": dict(sorted(written.items())),
    }
    for key, value in config.others.items():
        tree.setdefault(key, value)
    return yaml_text({"moveit_setup_assistant_config": tree})


_ROS2_NAMES = ("urdf", "srdf", "package_settings")


def _plain(value: Any) -> Any:
    """Return a value of plain dictionaries and lists, so that no tags or anchors are written."""
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    return value
