"""What is set for all nodes that follow, to the end of the group."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_ros.launch_graph import launch_node
from gazelle.launch.ros2.launch_ros.utilities import (
    evaluate_parameter_dict,
    make_namespace_absolute,
    normalize_parameter_dict,
    prefix_namespace,
)
from gazelle.launch.ros2.launch_ros.utilities.namespaces import (
    InvalidNamespaceError,
    check_namespace,
)
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.substitutions import SubstitutionFailure
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)
from gazelle.user_folders import ros_log_folder

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "PushROSNamespace",
    "SetParameter",
    "SetParametersFromFile",
    "SetROSLogDir",
    "SetRemap",
    "SetUseSimTime",
]

_PARAMETERS = "global_params"
_REMAPS = "ros_remaps"
_NAMESPACE = "ros_namespace"


def _append(context: LaunchContext, name: str, items: list[Any]) -> None:
    """Add to a list of the scope; the list of the scope around stays as it is."""
    configurations: dict[str, Any] = context.launch_configurations
    configurations[name] = [*(configurations.get(name) or ()), *items]


@expose_action("push_ros_namespace")
@expose_action("push-ros-namespace")
class PushROSNamespace(Action):
    """Puts a namespace before those of all nodes that follow.

    Attributes:
        namespace: relative to the one there is; an absolute one takes its place.
    """

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.namespace = normalize_to_list_of_substitutions(namespace)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<push_ros_namespace>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["namespace"] = parser.parse_substitution(entity.get_attr("namespace"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set the namespace.

        Raises:
            SubstitutionFailure: it is not legal.
        """
        pushed = perform_substitutions(context, self.namespace)
        previous = context.launch_configurations.get(_NAMESPACE)
        full = make_namespace_absolute(prefix_namespace(previous, pushed))
        assert full is not None
        try:
            check_namespace(full)
        except InvalidNamespaceError as error:
            raise SubstitutionFailure(
                f"The resulting namespace is invalid: [previous_namespace='{previous}', "
                f"pushed_namespace='{pushed}']: {error}"
            ) from error
        context.launch_configurations[_NAMESPACE] = full


@expose_action("set_parameter")
class SetParameter(Action):
    """Sets a parameter of all nodes that follow."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        key = tuple(normalize_to_list_of_substitutions(name))
        self.__values = normalize_parameter_dict({key: value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<set_parameter>``."""
        _, kwargs = super().parse(entity, parser)
        for key in ("name", "value"):
            kwargs[key] = parser.parse_substitution(entity.get_attr(key))
        return cls, kwargs

    @property
    def name(self) -> Any:
        """What the name is made of."""
        return next(iter(self.__values))

    @property
    def value(self) -> Any:
        """What the value is made of."""
        return next(iter(self.__values.values()))

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        values = evaluate_parameter_dict(context, self.__values)
        _append(context, _PARAMETERS, list(values.items()))


@expose_action("set_parameters_from_file")
class SetParametersFromFile(Action):
    """Gives a file of parameters to all nodes that follow."""

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__file = normalize_to_list_of_substitutions(filename)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<set_parameters_from_file>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["filename"] = parser.parse_substitution(entity.get_attr("filename"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Add the file."""
        _append(context, _PARAMETERS, [perform_substitutions(context, self.__file)])


@expose_action("set_remap")
class SetRemap(Action):
    """Remaps a name in all nodes that follow.

    Attributes:
        src: the name.
        dst: what to use instead.
    """

    def __init__(
        self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.src = normalize_to_list_of_substitutions(src)
        self.dst = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<set_remap>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["src"] = parser.parse_substitution(entity.get_attr("from"))
        kwargs["dst"] = parser.parse_substitution(entity.get_attr("to"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Add the rule."""
        pair = (perform_substitutions(context, self.src), perform_substitutions(context, self.dst))
        _append(context, _REMAPS, [pair])


@expose_action("set_use_sim_time")
class SetUseSimTime(Action):
    """Lets the launch's own clock, that of `ROSTimer`, follow ``/clock`` or not."""

    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<set_use_sim_time>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def value(self) -> Any:
        """Whether it is to follow."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """Choose the clock."""
        node = launch_node(context)
        node.clock.use(perform_typed_substitution(context, self.__value, bool))
        node.clock.follow(node)


@expose_action("set_ros_log_dir")
class SetROSLogDir(Action):
    """Sets ``ROS_LOG_DIR`` for all processes that follow.

    Attributes:
        log_dir: absolute, or relative to the one there is.
    """

    def __init__(self, new_log_dir: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.log_dir = normalize_to_list_of_substitutions(new_log_dir)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<set_ros_log_dir>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["new_log_dir"] = parser.parse_substitution(entity.get_attr("new_log_dir"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set the folder."""
        wanted = perform_substitutions(context, self.log_dir)
        context.environment["ROS_LOG_DIR"] = str(ros_log_folder(context.environment) / wanted)
