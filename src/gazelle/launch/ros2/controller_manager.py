"""controller_manager.launch_utils: launch descriptions with spawners of controllers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gazelle.launch.ros2.actions import DeclareLaunchArgument
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_ros.actions import Node
from gazelle.launch.ros2.substitutions import LaunchConfiguration, PythonExpression

__all__ = [
    "generate_controllers_spawner_launch_description",
    "generate_controllers_spawner_launch_description_from_dict",
    "generate_load_controller_launch_description",
    "generate_spawner_launch_description",
]

_FLAGS = {"load_only": "--load-only", "inactive": "--inactive"}


def generate_controllers_spawner_launch_description(
    controller_names: Sequence[Any],
    controller_params_files: Sequence[Any] | None = None,
    extra_spawner_args: Sequence[Any] = (),
) -> LaunchDescription:
    """Return a spawner of controllers, and the arguments that it takes from the command line.

    The arguments are ``controller_manager_name`` and ``unload_on_kill``.

    Args:
        controller_names: of the controllers, which are loaded and activated.
        controller_params_files: files with their parameters.
        extra_spawner_args: more words for the spawner, such as ``--load-only``.
    """
    argv: list[Any] = [*controller_names, "--controller-manager"]
    argv.append(LaunchConfiguration("controller_manager_name"))
    for file in controller_params_files or ():
        argv += ["--param-file", file] if file else []
    unload: list[Any] = ['"--unload-on-kill" if "true" == "', LaunchConfiguration("unload_on_kill")]
    argv.append(PythonExpression([*unload, '" else ""']))
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "controller_manager_name",
                default_value="controller_manager",
                description="Name of the controller manager's node",
            ),
            DeclareLaunchArgument(
                "unload_on_kill",
                default_value="false",
                description="Wait for the end, and unload the controllers then",
            ),
            _spawner([*argv, *extra_spawner_args]),
        ]
    )


def generate_controllers_spawner_launch_description_from_dict(
    controller_info_dict: Mapping[str, Any], extra_spawner_args: Sequence[Any] = ()
) -> LaunchDescription:
    """Return a spawner of controllers whose names have a file, several files, or None.

    Raises:
        ValueError: it is no dict, or a value in it is something else.
    """
    _check_dict(controller_info_dict)
    files = [file for value in controller_info_dict.values() for file in _files(value)]
    return generate_controllers_spawner_launch_description(
        controller_names=list(controller_info_dict),
        controller_params_files=files,
        extra_spawner_args=extra_spawner_args,
    )


def generate_load_controller_launch_description(
    controller_name: Any,
    controller_params_file: Any = None,
    extra_spawner_args: Sequence[Any] = (),
) -> LaunchDescription:
    """Return a spawner of one controller."""
    return generate_controllers_spawner_launch_description(
        controller_names=[controller_name],
        controller_params_files=[controller_params_file] if controller_params_file else None,
        extra_spawner_args=extra_spawner_args,
    )


def generate_spawner_launch_description(
    controller_info_dict: Mapping[str, Mapping[str, Any]], extra_spawner_args: Sequence[Any] = ()
) -> LaunchDescription:
    """Return a spawner of controllers that have arguments of their own.

    Args:
        controller_info_dict: by name of the controller: ``param_file`` (a path or several),
            ``load_only`` and ``inactive`` (True or False), ``ros_args`` (a text).
        extra_spawner_args: more words for the spawner.

    Raises:
        ValueError: it is no dict, or one of its values has another type.
    """
    _check_dict(controller_info_dict)
    argv: list[Any] = []
    for name, given in controller_info_dict.items():
        argv += ["--controller", name]
        for file in _files(given.get("param_file")):
            argv += ["--param-file", file]
        for key, flag in _FLAGS.items():
            argv += [flag] if _checked(given.get(key, False), bool, key) else []
        if "ros_args" in given:
            argv += ["--controller-ros-args", _checked(given["ros_args"], str, "ros_args")]
    return LaunchDescription([_spawner([*argv, *extra_spawner_args])])


def _spawner(argv: Sequence[Any]) -> Node:
    return Node(  # noqa: S604 - as the original: an empty word disappears
        package="controller_manager",
        executable="spawner",
        arguments=argv,
        shell=True,
        output="screen",
    )


def _files(value: Any) -> list[Any]:
    if not value:
        return []
    if not isinstance(value, (list, str)):
        raise ValueError(
            f"Invalid controller_params_file type parsed in the dict {value}. Expected str or list,"
            f" got {type(value)}."
        )
    return value if isinstance(value, list) else [value]


def _check_dict(value: Any) -> None:
    if not isinstance(value, dict):
        raise ValueError(f"Invalid controller_info_dict type parsed {value}")


def _checked(value: Any, kind: type, key: str) -> Any:
    if type(value) is not kind:
        raise ValueError(
            f"Invalid {key} type parsed in the dict {value}. Expected {kind.__name__}, got"
            f" {type(value)}."
        )
    return value
