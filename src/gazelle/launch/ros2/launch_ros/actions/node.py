"""launch_ros.actions.node: nodes."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.documents.files import is_file, is_folder
from gazelle.documents.yaml import MESSAGE_STYLE, PYTHON_STYLE, Layout, Writer, dump_yaml
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.actions import ExecuteProcess
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_ros.actions.node_keywords import (
    check_keywords,
    check_lists,
    newer_names,
)
from gazelle.launch.ros2.launch_ros.actions.node_markup import node_arguments
from gazelle.launch.ros2.launch_ros.launch_graph import carry_graph
from gazelle.launch.ros2.launch_ros.node_executable import NodeExecutable
from gazelle.launch.ros2.launch_ros.parameter_descriptions import Parameter, write_temporary
from gazelle.launch.ros2.launch_ros.substitutions import ExecutableInPackage
from gazelle.launch.ros2.launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameters,
    normalize_remap_rules,
    prefix_namespace,
)
from gazelle.launch.ros2.launch_ros.utilities.namespaces import check_name, check_namespace
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.nodes.arguments import ABSENT_NODES

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Node", "NodeActionExtension"]

_OLD_NAMES = {
    "node_executable": "executable",
    "node_name": "name",
    "node_namespace": "namespace",
}


class NodeActionExtension:
    """What a package may do to nodes before they start (entry point ``launch_ros.node_action``).

    Attributes:
        NAME: of its entry point.
    """

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"

    def prepare_for_execute(
        self, context: LaunchContext, ros_specific_arguments: dict[str, Any], node_action: Node
    ) -> tuple[list[Any], dict[str, Any]]:
        """Return words to add to the command, and ``__node:=`` and ``__ns:=`` changed or not."""
        return [], ros_specific_arguments


@expose_action("node")
class Node(ExecuteProcess):
    """Runs a node.

    The executable is looked for in the user's package, then among Gazelle's own nodes, then in an
    installed ROS. Parameters in dictionaries go to it by a file, as in ROS 2.

    Attributes:
        is_absent: it was to start and is compiled code that is not here, or does not compile.
    """

    is_absent = False

    UNSPECIFIED_NODE_NAME: ClassVar[str] = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE: ClassVar[str] = "<node_namespace_unspecified>"

    def __init__(  # noqa: PLR0913 - the signature of launch_ros
        self,
        *,
        executable: SomeSubstitutionsType | None = None,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: Any = None,
        remappings: Iterable[Any] | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        given = {"executable": executable, "name": name, "namespace": namespace}
        given, kwargs = newer_names(type(self).__name__, given, kwargs, _OLD_NAMES)
        if given["executable"] is None:
            check_keywords(type(self), kwargs)
            raise TypeError("Node() missing 1 required keyword-only argument: 'executable'")
        check_keywords(type(self), kwargs)
        check_lists(parameters=parameters, remappings=remappings, arguments=arguments)
        own = [*(arguments or ())]
        if ros_arguments is not None:
            own += ["--ros-args", *ros_arguments]
        first = (
            normalize_to_list_of_substitutions(given["executable"])
            if package is None
            else [ExecutableInPackage(package=package, executable=given["executable"])]
        )
        super().__init__(cmd=[first, *own, "--ros-args"], name=exec_name, **kwargs)
        self.process_description = NodeExecutable.of(self.process_description)
        self.__package = package
        self.__executable = given["executable"]
        self.__name = _subs(given["name"])
        self.__namespace = _subs(given["namespace"])
        self.__parameters = normalize_parameters(parameters or ())
        self.__remappings = list(normalize_remap_rules(remappings or ()))
        self.__expanded_name = self.UNSPECIFIED_NODE_NAME
        self.__expanded_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.__final_name: str | None = None
        self.__expanded_remappings: list[tuple[str, str]] | None = None
        self.__ros_arguments: list[str] | None = None

    @staticmethod
    def parse_nested_parameters(params: Iterable[Entity], parser: Parser) -> list[Any]:
        """Return what ``<param>`` elements mean, for the argument `parameters`."""
        from gazelle.launch.ros2.launch_ros.actions.node_markup import parameters_of

        return parameters_of(params, parser)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: list[str] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<node>``."""
        _, kwargs = super().parse(entity, parser, ignore=["cmd", "name", *(ignore or ())])
        return cls, {**kwargs, **node_arguments(entity, parser, cls._parse_cmdline)}

    @property
    def node_package(self) -> Any:
        """The package as given."""
        return self.__package

    @property
    def node_executable(self) -> Any:
        """The executable as given."""
        return self.__executable

    @property
    def node_name(self) -> str:
        """The absolute name.

        Raises:
            RuntimeError: it has not been executed.
        """
        if self.__final_name is None:
            raise RuntimeError("cannot access 'node_name' before executing action")
        return self.__final_name

    @property
    def expanded_node_namespace(self) -> str:
        """The absolute namespace, or a word for none."""
        return self.__expanded_namespace

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]] | None:
        """The remaps as texts, None without any."""
        return self.__expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Return whether both name and namespace are given."""
        unknown = (self.UNSPECIFIED_NODE_NAME, self.UNSPECIFIED_NODE_NAMESPACE)
        return not any(word in self.node_name for word in unknown)

    def _perform_substitutions(self, context: LaunchContext) -> None:
        """Find out names, parameters and remaps, once."""
        if self.__ros_arguments is not None:
            return
        self.__expand_names(context)
        argv: list[str] = []
        for one in context.launch_configurations.get("global_params") or ():
            argv += _global_parameter(one)
        for one in evaluate_parameters(context, self.__parameters):
            argv += self.__parameter_arguments(context, one)
        self.__expanded_remappings = self.__expand_remaps(context) or None
        for source, target in self.__expanded_remappings or ():
            argv += ["-r", f"{source}:={target}"]
        self.__ros_arguments = argv

    def __expand_names(self, context: LaunchContext) -> None:
        if self.__name is not None:
            self.__expanded_name = perform_substitutions(context, self.__name)
            check_name(self.__expanded_name)
        own = self.__namespace
        space = None if own is None else perform_substitutions(context, own)
        base = context.launch_configurations.get("ros_namespace")
        full = make_namespace_absolute(prefix_namespace(base, space))
        if full is not None:
            check_namespace(full)
            self.__expanded_namespace = full
        self.__final_name = prefix_namespace(self.__expanded_namespace, self.__expanded_name)

    def __parameter_arguments(self, context: LaunchContext, given: Any) -> list[str]:
        if isinstance(given, Parameter):
            name, value = given.evaluate(context)
            return ["-p", f"{name}:={_yaml_text(value)}"]
        if isinstance(given, dict):
            return ["--params-file", str(self._write_parameters(given))]
        if not is_file(given):
            self.__tell_of_file(context, Path(given))
            return []
        return ["--params-file", str(given)]

    def __tell_of_file(self, context: LaunchContext, path: Path) -> None:
        message = f"Parameter file path is not a file: {path}"
        launch_logging.get_logger("launch_ros.actions.node").warning(message)
        names = [one.name for one in path.parent.iterdir()] if is_folder(path.parent) else []
        found = Diagnostics()
        fix = did_you_mean(path.name, sorted(names))
        found.report("ros2_launch.parameter-file", message, self.span, fix=fix)
        context.report(next(iter(found)))

    def _write_parameters(self, values: dict[str, Any]) -> Path:
        name = self.node_name if self.is_node_name_fully_specified() else "/**"
        plain = {key: _plain(value) for key, value in values.items()}
        data = {name: {"ros__parameters": plain}}
        return write_temporary(dump_yaml(data, PYTHON_STYLE._replace(allow_unicode=True)))

    def __expand_remaps(self, context: LaunchContext) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = []
        for one in context.launch_configurations.get("ros_remaps") or ():
            found.append((one[0], one[1]))
        for source, target in self.__remappings:
            pair = (perform_substitutions(context, one) for one in (source, target))
            found.append((*pair,))  # type: ignore[arg-type]
        return found

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start it.

        Raises:
            PackageNotFoundError: there is no such package.
            SubstitutionFailure: the package has no such executable.
            InvalidNodeNameError: its name is not legal.
        """
        self._perform_substitutions(context)
        what = self.process_description
        assert isinstance(what, NodeExecutable)
        if not what.find(context, self.__package, self.__executable, self.span):
            # Compiled code: that has been said, and the launch goes on without it.
            self.is_absent = True
            self.__note_absence(context)
            return None
        what.add_arguments([*self.__own_arguments(context), *(self.__ros_arguments or ())])
        carry_graph()
        if what.command is not None and what.command.has_to_be_compiled:
            context.cpp_builds.want(what.command.executable)
        found = super().execute(context)
        self.__count_name(context)
        return found

    async def _may_start(self, context: LaunchContext, details: dict[str, Any]) -> bool:
        may_start = await super()._may_start(context, details)
        what = self.process_description
        assert isinstance(what, NodeExecutable)
        if not may_start or what.command is None or not what.command.has_to_be_compiled:
            return may_start
        made = context.cpp_builds.made_of(what.command.executable)
        if made is None:
            self.is_absent = True
            self.__note_absence(context)
            name = what.command.program
            launch_logging.get_logger(name).error("it does not compile; the others go on")
            return False
        details["cmd"] = what.command.replaced_in(details["cmd"], made.command)
        what.final_cmd = details["cmd"]
        return True

    def __note_absence(self, context: LaunchContext) -> None:
        """Let nodes that wait for others, such as lifecycle managers, know who does not come."""
        space = self.__expanded_namespace
        base = "" if space == self.UNSPECIFIED_NODE_NAMESPACE else space.rstrip("/")
        if self.__name is not None:
            known = context.environment.get(ABSENT_NODES, "").split()
            context.environment[ABSENT_NODES] = " ".join([*known, f"{base}/{self.__expanded_name}"])

    def __own_arguments(self, context: LaunchContext) -> list[Any]:
        rules: dict[str, Any] = {}
        if self.__name is not None:
            rules["name"] = f"__node:={self.__expanded_name}"
        if self.__expanded_namespace != self.UNSPECIFIED_NODE_NAMESPACE:
            rules["ns"] = f"__ns:={self.__expanded_namespace}"
        added: list[Any] = []
        for extension in _extensions():
            more, rules = extension.prepare_for_execute(context, rules, self)
            added += more
        context.extend_locals({"ros_specific_arguments": rules})
        return [
            word for key in ("name", "ns") if key in rules for word in ("-r", rules[key])
        ] + added

    def __count_name(self, context: LaunchContext) -> None:
        if not self.is_node_name_fully_specified():
            return
        add_node_name(context, self.node_name)
        count = get_node_name_count(context, self.node_name)
        if count > 1:
            launch_logging.get_logger(str(self.name)).warning(
                f"there are now at least {count} nodes with the name {self.node_name} created "
                "within this launch context"
            )


def _subs(value: Any) -> Any:
    return None if value is None else normalize_to_list_of_substitutions(value)


def _global_parameter(given: Any) -> list[str]:
    """Return the words for what `SetParameter` or `SetParametersFromFile` has set."""
    if isinstance(given, tuple):
        name, value = given
        return ["-p", f"{name}:={_yaml_text(value) if isinstance(value, tuple) else value}"]
    path = Path(given).absolute()
    if not is_file(path):
        raise FileNotFoundError(f"SetParametersFromFile: '{path}' is not a file")
    return ["--params-file", str(path)]


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _yaml_text(value: Any) -> str:
    plain = _plain(value)
    style = MESSAGE_STYLE._replace(writer=Writer.PYTHON, layout=Layout.FLOW)
    text = dump_yaml(plain, style)
    return text.removesuffix("\n").removesuffix("\n...")


def _extensions() -> list[Any]:
    found = []
    for entry_point in importlib.metadata.entry_points(group="launch_ros.node_action"):
        try:
            extension = entry_point.load()()
        except Exception as error:  # noqa: BLE001 - a stranger's code, and the node starts anyway
            logger = launch_logging.get_logger("launch_ros.actions.node")
            logger.warning(f"Failed to load entry point '{entry_point.name}': {error}")
            continue
        extension.NAME = entry_point.name
        found.append(extension)
    return found
