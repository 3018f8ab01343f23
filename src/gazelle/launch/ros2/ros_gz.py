"""ros_gz_sim.actions, ros_gz_bridge.actions: the new Gazebo in launch files, by their names."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.diagnostics import did_you_mean
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions import IncludeLaunchDescription
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_description_sources import PythonLaunchDescriptionSource
from gazelle.workspace.ament_index import get_package_share_directory

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["GzServer", "GzSpawnModel", "RosGzBridge"]


class _Included(Action):
    """What a launch file of a package does, as an action; its arguments are the file's."""

    _package: ClassVar[str]
    _file: ClassVar[str]
    # What the action calls an argument, and what the file calls it.
    _names: ClassVar[dict[str, str]]
    _required: ClassVar[frozenset[str]] = frozenset()

    def __init__(self, *, condition: Any = None, **kwargs: Any) -> None:
        super().__init__(condition=condition)
        for name in kwargs:
            if name not in self._names:
                hint = did_you_mean(name, self._names)
                text = f"{type(self).__name__}() got an unexpected keyword argument '{name}'"
                raise TypeError(f"{text}; {hint}" if hint else text)
        for name in sorted(self._required - set(kwargs)):
            raise TypeError(
                f"{type(self).__name__}() missing 1 required keyword-only argument: '{name}'"
            )
        self.__given = {name: value for name, value in kwargs.items() if value is not None}

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of an element."""
        _, kwargs = super().parse(entity, parser)
        for name in cls._names:
            value = entity.get_attr(name, optional=name not in cls._required)
            if value is not None:
                kwargs[name] = parser.parse_substitution(value)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the launch file with what was given."""
        path = Path(get_package_share_directory(self._package)) / "launch" / self._file
        given = [(self._names[name], value) for name, value in self.__given.items()]
        include = IncludeLaunchDescription(
            PythonLaunchDescriptionSource(str(path)), launch_arguments=given
        )
        include.span = self.span
        return [include]


def _same(names: Iterable[str]) -> dict[str, str]:
    return {name: name for name in names}


@expose_action("gz_server")
class GzServer(_Included):
    """Starts a world of the new Gazebo."""

    _package = "ros_gz_sim"
    _file = "gz_server.launch.py"
    _names: ClassVar[dict[str, str]] = _same(
        (
            "world_sdf_file",
            "world_sdf_string",
            "container_name",
            "create_own_container",
            "use_composition",
        )
    )


@expose_action("gz_spawn_model")
class GzSpawnModel(_Included):
    """Puts a model into the running world of the new Gazebo."""

    _package = "ros_gz_sim"
    _file = "gz_spawn_model.launch.py"
    _names: ClassVar[dict[str, str]] = {
        **_same(("world", "file", "topic", "entity_name", "allow_renaming", "x", "y", "z")),
        **_same(("model_string", "R", "P", "Y")),
        **{"xml_string": "model_string", "roll": "R", "pitch": "P", "yaw": "Y"},
    }


@expose_action("ros_gz_bridge")
class RosGzBridge(_Included):
    """Passes topics on between ROS and the new Gazebo, as a file says."""

    _package = "ros_gz_bridge"
    _file = "ros_gz_bridge.launch.py"
    _names: ClassVar[dict[str, str]] = _same(
        (
            "bridge_name",
            "config_file",
            "container_name",
            "create_own_container",
            "namespace",
            "use_composition",
            "use_respawn",
            "log_level",
        )
    )
    _required = frozenset({"bridge_name", "config_file"})
