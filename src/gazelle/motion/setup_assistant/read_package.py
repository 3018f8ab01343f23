"""A config package that is there already, read to be changed; what nobody knows is kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, cast

from gazelle.description.model import Model
from gazelle.description.moveit import CartesianLimits
from gazelle.description.srdf import Srdf, load_srdf
from gazelle.description.srdf.reader import SRDF_ELEMENTS
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import is_file
from gazelle.documents.yaml import YamlError, load_yaml_file
from gazelle.motion.setup_assistant.config import (
    Author,
    ControllerChoice,
    JointLimitChoice,
    KinematicsChoice,
    RobotSource,
    RosVersion,
    SetupAssistantConfig,
)
from gazelle.motion.setup_assistant.hardware import (
    COMMAND_INTERFACES,
    TRAJECTORY_PLUGIN,
    added_joints,
    command_interfaces,
    has_manager_plugin,
)
from gazelle.motion.setup_assistant.package_files import SETUP_FILE, SetupAssistantError
from gazelle.motion.setup_assistant.robot_source import load_robot
from gazelle.workspace import Workspace
from gazelle.workspace.package_xml import Manifest, ManifestError, read_manifest

__all__ = ["read_config_package"]

Tree = Mapping[str, Any]
Kinds = tuple[str, ...]
_KNOWN_SETUP = frozenset(
    {"urdf", "srdf", "config", "package_settings", "modified_urdf", "control_xacro", "gazelle"}
)
_BROADCASTER = "joint_state_broadcaster"
_STATES = "joint_state_controller"


def read_config_package(
    folder: Path, *, workspace: Workspace, diagnostics: Diagnostics
) -> tuple[SetupAssistantConfig, Model]:
    """Read a package's choices, and its robot.

    Args:
        folder: of the package.
        workspace: finds the robot's package.
        diagnostics: receives findings about robot and SRDF.

    Raises:
        SetupAssistantError: it is no config package, or a file cannot be read.
    """
    return _Reader(folder, workspace, diagnostics).read()


class _Reader:
    def __init__(self, folder: Path, workspace: Workspace, diagnostics: Diagnostics) -> None:
        self._folder = folder
        self._workspace = workspace
        self._diagnostics = diagnostics

    def read(self) -> tuple[SetupAssistantConfig, Model]:
        if not is_file(self._folder / SETUP_FILE):
            raise SetupAssistantError(
                f"{self._folder} has no file {SETUP_FILE}: it is no package of the Setup Assistant"
            )
        setup = _tree(self._yaml(SETUP_FILE).get("moveit_setup_assistant_config"))
        manifest = self._manifest()
        version: RosVersion = 2 if manifest.build_type.startswith("ament") else 1
        own = _part(setup, "gazelle")
        source = self._source(_part(setup, "urdf"), own, manifest.name)
        model = load_robot(source, self._workspace, self._diagnostics)
        path = str(_part(setup, "srdf").get("relative_path") or f"config/{model.name}.srdf")
        srdf, others = self._srdf(path, model, source)
        author = _part(setup, "package_settings") or _part(setup, "config")
        driven, added = self._hardware(model, version)
        states = _part(setup, "control_xacro").get("state") or ("position", "velocity")
        managers = self._yaml(
            "config/ros2_controllers.yaml" if version == 2 else "config/ros_controllers.yaml"
        )
        controllers, rest = self._controllers(version, managers)
        limits = self._yaml("config/joint_limits.yaml")
        config = SetupAssistantConfig(
            manifest.name,
            version,
            source,
            srdf,
            "" if path == f"config/{srdf.name}.srdf" else path,
            others,
            int(own.get("collision_trials", 10_000)),
            float(own.get("always_fraction", 0.95)),
            _kinematics(self._yaml("config/kinematics.yaml")),
            self._planners(srdf),
            {name: _limit(_tree(row)) for name, row in _part(limits, "joint_limits").items()},
            float(limits.get("default_velocity_scaling_factor", 0.1)),
            float(limits.get("default_acceleration_scaling_factor", 0.1)),
            self._cartesian_limits(version),
            controllers,
            driven,
            tuple(str(kind) for kind in states),
            added,
            not has_manager_plugin(model),
            self._initial(own),
            self._sensors(),
            Author(
                str(author.get("author_name") or Author().name),
                str(author.get("author_email") or Author().email),
            ),
            manifest.description,
            {key: value for key, value in setup.items() if key.lower() not in _KNOWN_SETUP},
            rest,
        )
        return config, model

    def _manifest(self) -> Manifest:
        file = self._folder / "package.xml"
        try:
            return read_manifest(file)
        except (ManifestError, OSError) as error:
            raise SetupAssistantError(f"cannot read {file}: {error}") from error

    def _yaml(self, path: str) -> Tree:
        file = self._folder / path
        if not is_file(file):
            return {}
        try:
            return _tree(load_yaml_file(file))
        except (YamlError, OSError, UnicodeDecodeError) as error:
            raise SetupAssistantError(f"cannot read {file}: {error}") from error

    def _source(self, urdf: Tree, own: Tree, own_name: str) -> RobotSource:
        relative = str(urdf.get("relative_path") or "")
        package = str(urdf.get("package") or "")
        if not relative:
            raise SetupAssistantError(f"{self._folder / SETUP_FILE} does not name the robot's file")
        if package in ("", own_name):
            file = self._folder / relative
            text = file.read_text(encoding="utf-8") if is_file(file) else ""
            return RobotSource(file, "", relative, copied_text=text)
        folder = self._workspace.package(package).path
        return RobotSource(
            folder / relative,
            package,
            relative,
            xacro_args=str(urdf.get("xacro_args") or "").strip(),
            demo_args=str(own.get("demo_args") or "").strip(),
            gazebo_args=str(own.get("gazebo_args") or "").strip(),
            has_demo=bool(own.get("has_demo", True)),
        )

    def _srdf(self, path: str, model: Model, source: RobotSource) -> tuple[Srdf, tuple[Tag, ...]]:
        file = self._folder / path
        found = load_srdf(
            file,
            robot=model,
            workspace=self._workspace,
            diagnostics=self._diagnostics,
            mappings=source.mappings or None,
        )
        if found is None:
            raise SetupAssistantError(f"there is no SRDF in {file}")
        root = None if file.suffix == ".xacro" else read_xml(file, Diagnostics())
        others = () if root is None else root.children
        return found, tuple(tag for tag in others if tag.name not in SRDF_ELEMENTS)

    def _hardware(
        self, model: Model, version: RosVersion
    ) -> tuple[dict[str, Kinds], tuple[str, ...]]:
        """What joints are commanded by, and which of them the package adds to the robot's."""
        interfaces = command_interfaces(model, version)
        name = f"{model.name}.ros2_control" if version == 2 else f"gazebo_{model.name}.urdf"
        file = self._folder / "config" / f"{name}.xacro"
        root = read_xml(file, Diagnostics()) if is_file(file) else None
        written = {} if root is None else _written_interfaces(root)
        if root is None:
            return interfaces, ()
        own = [
            joint for joint in interfaces if joint not in added_joints(model, interfaces, version)
        ]
        kept = {name: kinds for name, kinds in interfaces.items() if name in {*own, *written}}
        return {**kept, **written}, tuple(written)

    def _controllers(
        self, version: RosVersion, managers: Tree
    ) -> tuple[tuple[ControllerChoice, ...], Tree]:
        if version == 1:
            listed = self._yaml("config/simple_moveit_controllers.yaml").get("controller_list")
            rows = {str(_tree(row).get("name")): _tree(row) for row in listed or ()}
            types = {name: str(_part(managers, name).get("type", "")) for name in managers}
            given = {name: _without(_part(managers, name), "type") for name in managers}
            others = _without(managers, _STATES, *rows)
        else:
            written = self._yaml("config/moveit_controllers.yaml")
            branch = _part(written, "moveit_simple_controller_manager")
            rows = {str(name): _part(branch, name) for name in branch.get("controller_names", ())}
            manager = _part(_part(managers, "controller_manager"), "ros__parameters")
            types = {name: str(_tree(row).get("type", "")) for name, row in manager.items()}
            given = {
                name: dict(_part(_part(managers, name), "ros__parameters")) for name in managers
            }
            inner = _without(manager, _BROADCASTER, *rows)
            if inner.get("update_rate") == 100:
                inner = _without(inner, "update_rate")
            others = _without(managers, "controller_manager", *rows)
            others = {**({"controller_manager": inner} if inner else {}), **others}
        choices = tuple(
            _controller(name, row, types.get(name, ""), given.get(name, {}))
            for name, row in rows.items()
        )
        return choices, others

    def _planners(self, srdf: Srdf) -> dict[str, str]:
        tree = self._yaml("config/ompl_planning.yaml")
        named = {
            group.name: str(_part(tree, group.name).get("default_planner_config") or "")
            for group in srdf.groups
        }
        return {group: planner for group, planner in named.items() if planner}

    def _cartesian_limits(self, version: RosVersion) -> CartesianLimits:
        name = "cartesian_limits" if version == 1 else "pilz_cartesian_limits"
        written = _part(self._yaml(f"config/{name}.yaml"), "cartesian_limits")
        known = {item.name for item in fields(CartesianLimits)}
        return CartesianLimits(
            **{key: float(value) for key, value in written.items() if key in known}
        )

    def _initial(self, own: Tree) -> dict[str, float]:
        tree = self._yaml("config/initial_positions.yaml")
        written = _part(tree, "initial_positions") or _part(own, "initial_positions")
        return {str(name): float(value) for name, value in written.items()}

    def _sensors(self) -> tuple[Tree, ...]:
        tree = self._yaml("config/sensors_3d.yaml")
        rows = [tree.get(row) if isinstance(row, str) else row for row in tree.get("sensors") or ()]
        return tuple(_tree(row) for row in rows if row)


def _tree(value: Any) -> Tree:
    return cast("Tree", value) if isinstance(value, Mapping) else {}


def _part(tree: Tree, name: str) -> Tree:
    """A branch of a tree; ROS 1 writes those of ``.setup_assistant`` in capitals."""
    return _tree(tree.get(name, tree.get(name.upper())))


def _without(tree: Tree, *names: str) -> dict[str, Any]:
    return {key: value for key, value in tree.items() if key not in names}


def _kinematics(tree: Tree) -> dict[str, KinematicsChoice]:
    return {str(group): _solver(_tree(row)) for group, row in tree.items()}


def _solver(row: Tree) -> KinematicsChoice:
    default = KinematicsChoice()
    prefix = "kinematics_solver"
    return KinematicsChoice(
        str(row.get(prefix, default.solver)),
        float(row.get(f"{prefix}_search_resolution", default.search_resolution)),
        float(row.get(f"{prefix}_timeout", default.timeout_s)),
        bool(row.get("position_only_ik", False)),
        _without(
            row, prefix, f"{prefix}_search_resolution", f"{prefix}_timeout", "position_only_ik"
        ),
    )


def _limit(row: Tree) -> JointLimitChoice:
    names = ("has_velocity_limits", "max_velocity", "has_acceleration_limits", "max_acceleration")
    return JointLimitChoice(
        bool(row.get(names[0], False)),
        float(row.get(names[1], 0.0)),
        bool(row.get(names[2], False)),
        float(row.get(names[3], 0.0)),
        _without(row, *names),
    )


def _controller(name: str, row: Tree, plugin: str, given: Tree) -> ControllerChoice:
    return ControllerChoice(
        name,
        str(row.get("type", "FollowJointTrajectory")),
        tuple(str(joint) for joint in row.get("joints", ())),
        plugin or TRAJECTORY_PLUGIN,
        str(row.get("action_ns", "")),
        bool(row.get("default", False)),
        _without(given, "joint", "joints"),
        _without(row, "name", "type", "joints", "action_ns", "default"),
    )


def _written_interfaces(root: Tag) -> dict[str, tuple[str, ...]]:
    """Return what joints are commanded by in a file that the assistant wrote."""
    found: dict[str, tuple[str, ...]] = {}
    for tag in root.walk():
        if tag.name != "joint":
            continue
        kinds = [item.attributes.get("name", "") for item in tag.find_all("command_interface")]
        kinds += [
            kind
            for item in tag.find_all("hardwareInterface")
            for kind in COMMAND_INTERFACES
            if kind in item.text.lower()
        ]
        if kinds:
            found[tag.attributes.get("name", "")] = tuple(kinds)
    return found
