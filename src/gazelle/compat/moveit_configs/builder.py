"""``MoveItConfigsBuilder``: makes `MoveItConfigs` of the files of a MoveIt config package."""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.compat.moveit_configs.parameter_builder import ParameterBuilder, expanded_parameter
from gazelle.compat.moveit_configs.parameter_files import (
    ParameterBuilderFileNotFoundError,
    load_yaml,
)
from gazelle.description.moveit import DEFAULT_CONFIGS
from gazelle.workspace.ament_index import get_package_share_directory

__all__ = ["MoveItConfigs", "MoveItConfigsBuilder", "get_pattern_matches"]

Parameters = dict[str, Any]
_CONFIG = Path("config")
_PIPELINE = re.compile("^(.*)_planning.yaml$")
_CONTROLLERS = re.compile("^(.*)_controllers.yaml$")
_PILZ = "pilz_industrial_motion_planner"
_LOGGER = logging.getLogger("moveit_configs_utils")


def _capabilities() -> Parameters:
    return {"capabilities": "", "disable_capabilities": ""}


@dataclass(slots=True)
class MoveItConfigs:
    """Parameters of MoveIt, each group ready to be given to a node.

    Attributes:
        package_path: the MoveIt config package.
        robot_description: the URDF.
        robot_description_semantic: the SRDF.
        robot_description_kinematics: settings of inverse kinematics.
        planning_pipelines: names, default and parameters of pipelines.
        trajectory_execution: controllers and execution.
        planning_scene_monitor: what is published of the scene.
        sensors_3d: sensors of the octomap.
        move_group_capabilities: capabilities besides the usual ones.
        joint_limits: limits that take the place of the URDF's.
        moveit_cpp: of MoveItCpp and MoveItPy.
        pilz_cartesian_limits: limits of the tip for Pilz' planner.
    """

    package_path: Path | None = None
    robot_description: Parameters = field(default_factory=dict)
    robot_description_semantic: Parameters = field(default_factory=dict)
    robot_description_kinematics: Parameters = field(default_factory=dict)
    planning_pipelines: Parameters = field(default_factory=dict)
    trajectory_execution: Parameters = field(default_factory=dict)
    planning_scene_monitor: Parameters = field(default_factory=dict)
    sensors_3d: Parameters = field(default_factory=dict)
    move_group_capabilities: Parameters = field(default_factory=_capabilities)
    joint_limits: Parameters = field(default_factory=dict)
    moveit_cpp: Parameters = field(default_factory=dict)
    pilz_cartesian_limits: Parameters = field(default_factory=dict)

    def to_dict(self) -> Parameters:
        """Return all parameters of move_group; limits of joints and of the tip are merged."""
        parameters: Parameters = {}
        parameters |= self.robot_description
        parameters |= self.robot_description_semantic
        parameters |= self.robot_description_kinematics
        parameters |= self.planning_pipelines
        parameters |= self.trajectory_execution
        parameters |= self.planning_scene_monitor
        parameters |= self.sensors_3d
        parameters |= self.joint_limits
        parameters |= self.moveit_cpp
        for key, limits in self.pilz_cartesian_limits.items():
            parameters[key] = {**parameters.get(key, {}), **limits}
        return parameters


def get_pattern_matches(folder: Path, pattern: re.Pattern[str]) -> list[Any]:
    """Return the first group of every file name that matches, or its path without groups.

    The names are sorted, so that the same package gives the same parameters everywhere; the
    original has them in the file system's order.
    """
    if not folder.exists():
        return []
    files = sorted(one for one in folder.iterdir() if one.is_file())
    found = [(file, pattern.search(file.name)) for file in files]
    return [match[1] if match.re.groups else file for file, match in found if match]


class MoveItConfigsBuilder(ParameterBuilder):
    """Loads the parameters of a robot's MoveIt config package.

    Every loading method takes another file than the usual one, absolute or relative to the
    package, and returns the builder; what was not loaded is by `to_moveit_configs`.
    """

    def __init__(
        self,
        robot_name: str,
        robot_description: str = "robot_description",
        package_name: str | None = None,
    ) -> None:
        """Find URDF and SRDF of a robot.

        Args:
            robot_name: the package is ``ROBOT_moveit_config``, the files ``config/ROBOT.…``.
            robot_description: name of the parameter with the URDF, and beginning of the others.
            package_name: the package, when it has another name.

        Raises:
            PackageNotFoundError: there is no such package.
        """
        super().__init__(package_name or f"{robot_name}_moveit_config")
        self._configs = MoveItConfigs(package_path=self._package_path)
        self._robot_name = robot_name
        self._name = robot_description
        self._xacro_args: dict[str, str] | None = None
        setup = self._setup()
        self._urdf = self._urdf_file(setup.get("urdf", setup.get("URDF")) or {})
        self._srdf = self._srdf_file(setup.get("srdf", setup.get("SRDF")) or {})

    def robot_description(
        self, file_path: str | Path | None = None, mappings: Mapping[str, Any] | None = None
    ) -> MoveItConfigsBuilder:
        """Load the URDF; `mappings` are arguments of xacro, texts or substitutions.

        With substitutions the file is expanded when the launch knows their values. Without the
        file it is said that the URDF has to come by topic, as the original does.
        """
        file = self._urdf if file_path is None else self._file(file_path, "robot_description")
        try:
            text = expanded_parameter(file, mappings or self._xacro_args)
        except ParameterBuilderFileNotFoundError as error:
            _LOGGER.warning("%s", error)
            _LOGGER.warning("The robot description will be loaded from /robot_description topic")
            return self
        self._configs.robot_description = {self._name: text}
        return self

    def robot_description_semantic(
        self, file_path: str | Path | None = None, mappings: Mapping[str, Any] | None = None
    ) -> MoveItConfigsBuilder:
        """Load the SRDF; `mappings` are arguments of xacro, texts or substitutions."""
        text = expanded_parameter(
            self._file(file_path or self._srdf, "robot_description_semantic"), mappings
        )
        self._configs.robot_description_semantic = {f"{self._name}_semantic": text}
        return self

    def robot_description_kinematics(
        self, file_path: str | Path | None = None
    ) -> MoveItConfigsBuilder:
        """Load settings of inverse kinematics, ``config/kinematics.yaml``."""
        values = load_yaml(
            self._file(file_path or _CONFIG / "kinematics.yaml", "robot_description_kinematics")
        )
        self._configs.robot_description_kinematics = {f"{self._name}_kinematics": values}
        return self

    def joint_limits(self, file_path: str | Path | None = None) -> MoveItConfigsBuilder:
        """Load limits of joints, ``config/joint_limits.yaml``."""
        values = load_yaml(self._file(file_path or _CONFIG / "joint_limits.yaml", "joint_limits"))
        self._configs.joint_limits = {f"{self._name}_planning": values}
        return self

    def moveit_cpp(self, file_path: str | Path | None = None) -> MoveItConfigsBuilder:
        """Load parameters of MoveItCpp, ``config/moveit_cpp.yaml``."""
        values = load_yaml(self._file(file_path or _CONFIG / "moveit_cpp.yaml", "moveit_cpp"))
        self._configs.moveit_cpp = values
        return self

    def trajectory_execution(
        self, file_path: str | Path | None = None, moveit_manage_controllers: bool = True
    ) -> MoveItConfigsBuilder:
        """Load controllers, ``config/moveit_controllers.yaml`` or what is most like it.

        Raises:
            RuntimeError: there are several such files and none has a usual name.
        """
        self._configs.trajectory_execution = {
            "moveit_manage_controllers": moveit_manage_controllers
        }
        file = (
            self._controllers()
            if file_path is None
            else self._file(file_path, "trajectory_execution")
        )
        if file is not None:
            self._configs.trajectory_execution.update(load_yaml(file))
        return self

    def planning_scene_monitor(
        self,
        publish_planning_scene: bool = True,
        publish_geometry_updates: bool = True,
        publish_state_updates: bool = True,
        publish_transforms_updates: bool = True,
        publish_robot_description: bool = False,
        publish_robot_description_semantic: bool = False,
    ) -> MoveItConfigsBuilder:
        """Say what is published of the planning scene."""
        self._configs.planning_scene_monitor = {
            "publish_planning_scene": publish_planning_scene,
            "publish_geometry_updates": publish_geometry_updates,
            "publish_state_updates": publish_state_updates,
            "publish_transforms_updates": publish_transforms_updates,
            "publish_robot_description": publish_robot_description,
            "publish_robot_description_semantic": publish_robot_description_semantic,
        }
        return self

    def sensors_3d(self, file_path: str | Path | None = None) -> MoveItConfigsBuilder:
        """Load sensors of the octomap, ``config/sensors_3d.yaml``, if there are any."""
        file = self._file(file_path or _CONFIG / "sensors_3d.yaml", "sensors_3d")
        values = load_yaml(file) if file.exists() else None
        if values and values.get("sensors") and values["sensors"][0]:
            self._configs.sensors_3d = values
        return self

    def planning_pipelines(
        self,
        default_planning_pipeline: str | None = None,
        pipelines: list[str] | None = None,
        load_all: bool = True,
    ) -> MoveItConfigsBuilder:
        """Load ``config/*_planning.yaml``.

        Args:
            default_planning_pipeline: its name; ``ompl`` when None, if it is there.
            pipelines: names; all that the package has when None.
            load_all: without `pipelines`, those that MoveIt brings are loaded as well.

        Raises:
            RuntimeError: the default is none of the pipelines.
        """
        folder = self._package_path / _CONFIG
        if pipelines is None:
            names = get_pattern_matches(folder, _PIPELINE)
            others = get_pattern_matches(DEFAULT_CONFIGS, _PIPELINE) if load_all else []
            pipelines = names + [name for name in others if name not in names]
        default = default_planning_pipeline or ("ompl" if "ompl" in pipelines else pipelines[0])
        if default not in pipelines:
            raise RuntimeError(
                f"default_planning_pipeline: `{default}` doesn't name any of the input pipelines"
                f" `{','.join(pipelines)}`"
            )
        found: dict[str, Any] = {
            "planning_pipelines": pipelines,
            "default_planning_pipeline": default,
        }
        for name in pipelines:
            own = folder / f"{name}_planning.yaml"
            found[name] = load_yaml(own if own.exists() else DEFAULT_CONFIGS / own.name)
        if "ompl" in found and "planner_configs" not in found["ompl"]:
            found["ompl"].update(load_yaml(DEFAULT_CONFIGS / "ompl_defaults.yaml"))
        self._configs.planning_pipelines = found
        return self

    def pilz_cartesian_limits(self, file_path: str | Path | None = None) -> MoveItConfigsBuilder:
        """Load limits of the tip, ``config/pilz_cartesian_limits.yaml``."""
        if (self._package_path / _CONFIG / "cartesian_limits.yaml").exists():
            _LOGGER.warning(
                "cartesian_limits.yaml is deprecated, please rename to pilz_cartesian_limits.yaml"
            )
        file = self._file(
            file_path or _CONFIG / "pilz_cartesian_limits.yaml", "pilz_cartesian_limits"
        )
        self._configs.pilz_cartesian_limits = {f"{self._name}_planning": load_yaml(file)}
        return self

    def to_moveit_configs(self) -> MoveItConfigs:
        """Load what was not loaded yet, from the usual files, and return everything.

        A missing file is an error, as in MoveIt, except for that with the limits of Pilz'
        planner: MoveIt brings this planner along and stops where a package has no limits for it.
        """
        configs = self._configs
        for name in (
            *("robot_description", "robot_description_semantic", "robot_description_kinematics"),
            *("planning_pipelines", "trajectory_execution", "planning_scene_monitor"),
            *("sensors_3d", "joint_limits"),
        ):
            if not getattr(configs, name):
                getattr(self, name)()
        if _PILZ in configs.planning_pipelines and not configs.pilz_cartesian_limits:
            self._load_pilz_limits()
        return configs

    def to_dict(self, include_moveit_configs: bool = True) -> dict[str, Any]:
        """Return all parameters, or only those that were added one by one."""
        if include_moveit_configs:
            self._parameters.update(self.to_moveit_configs().to_dict())
        return self._parameters

    def _load_pilz_limits(self) -> None:
        file = self._package_path / _CONFIG / "pilz_cartesian_limits.yaml"
        if file.exists():
            self.pilz_cartesian_limits()
            return
        _LOGGER.warning(
            "File %s doesn't exist: the LIN and CIRC motions of Pilz' planner have no limits of the"
            " tip. Gazelle goes on, moveit_configs_utils stops the launch here; add the file with"
            " cartesian_limits: {max_trans_vel: 1.0, max_trans_acc: 2.25, max_trans_dec: -5.0,"
            " max_rot_vel: 1.57}",
            file,
        )

    def _setup(self) -> dict[str, Any]:
        file = self._package_path / ".setup_assistant"
        values = load_yaml(file) if file.exists() else None
        return (values or {}).get("moveit_setup_assistant_config", {}) or {}

    def _urdf_file(self, written: Mapping[str, Any]) -> Path:
        arguments = str(written.get("xacro_args") or "").split()
        if arguments:
            self._xacro_args = dict(word.split(":=", 1) for word in arguments if ":=" in word)
        own = self._package_path / _CONFIG / f"{self._robot_name}.urdf.xacro"
        if own.exists():
            return own
        if written:
            package = get_package_share_directory(written["package"])
            return Path(package) / str(written["relative_path"])
        return self._package_path / self._guessed("URDF", "urdf")

    def _srdf_file(self, written: Mapping[str, Any]) -> Path:
        if written:
            return Path(written["relative_path"])
        return self._guessed("SRDF", "srdf")

    def _guessed(self, what: str, ending: str) -> Path:
        file = _CONFIG / f"{self._robot_name}.{ending}"
        _LOGGER.warning("Cannot infer %s from `%s`. -- using %s", what, self._package_path, file)
        return file

    def _controllers(self) -> Path | None:
        folder = self._package_path / _CONFIG
        names = get_pattern_matches(folder, _CONTROLLERS)
        if not names:
            _LOGGER.warning(
                "trajectory_execution: `Parameter file_path is undefined and no matches for"
                " %s/*_controllers.yaml",
                folder,
            )
            return None
        if len(names) == 1:
            return folder / f"{names[0]}_controllers.yaml"
        for name in ("moveit", "moveit2", self._robot_name):
            if name in names:
                return folder / f"{name}_controllers.yaml"
        options = "\n - ".join(f"{name}_controllers.yaml" for name in names)
        raise RuntimeError(
            "trajectory_execution: Unable to guess which parameter file to load. Options:\n"
            f" - {options}"
        )
