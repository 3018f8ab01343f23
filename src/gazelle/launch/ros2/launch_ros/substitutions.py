"""launch_ros.substitutions: packages, executables and parameters as texts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.launch_ros.node_executable import node_command, wrapper_script
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions import SubstitutionFailure
from gazelle.launch.ros2.substitutions.substitution_failure import described
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.workspace.ament_index import get_package_prefix, get_package_share_directory

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "ExecutableInPackage",
    "FindPackage",
    "FindPackagePrefix",
    "FindPackageShare",
    "Parameter",
]


class FindPackage(Substitution):
    """A folder of a package; subclasses say which one.

    Attributes:
        package: the package's name.
    """

    def __init__(self, package: SomeSubstitutionsType) -> None:
        super().__init__()
        self.package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``$(find-pkg-… NAME)``."""
        if len(data) != 1:
            raise AttributeError("find package substitutions expect 1 argument")
        return cls, {"package": data[0]}

    def find(self, package_name: str) -> str:
        """Return the folder."""
        raise NotImplementedError

    def describe(self) -> str:
        """Return a text for people."""
        return f"{type(self).__name__}(pkg={described(self.package)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder.

        Raises:
            PackageNotFoundError: there is no such package.
            ValueError: the name is not legal.
        """
        return self.find(perform_substitutions(context, self.package))


@expose_substitution("find-pkg-prefix")
class FindPackagePrefix(FindPackage):
    """The prefix that a package is installed in; in a source tree the package's folder."""

    def find(self, package_name: str) -> str:
        """Return the prefix."""
        return get_package_prefix(package_name)


@expose_substitution("find-pkg-share")
class FindPackageShare(FindPackage):
    """The folder of a package's data; in a source tree the package's folder."""

    def find(self, package_name: str) -> str:
        """Return the folder."""
        return get_package_share_directory(package_name)


@expose_substitution("exec-in-pkg")
class ExecutableInPackage(FindPackagePrefix):
    """The path of an executable of a package.

    For a node that takes more than one word to run it is the path of a script that runs it.

    Attributes:
        executable: the executable's name.
    """

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__(package)
        self.executable = normalize_to_list_of_substitutions(executable)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of an ``$(exec-in-pkg NAME PACKAGE)``."""
        if len(data) != 2:
            raise AttributeError("exec-in-package substitution expects 2 arguments")
        return cls, {"executable": data[0], "package": data[1]}

    def describe(self) -> str:
        """Return a text for people."""
        return f"ExecInPkg(pkg={described(self.package)}, exec={described(self.executable)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path.

        Raises:
            PackageNotFoundError: there is no such package.
            SubstitutionFailure: it has no such executable.
        """
        package = perform_substitutions(context, self.package)
        name = perform_substitutions(context, self.executable)
        command = node_command(context, package, name, self.span)
        if command is None:
            raise SubstitutionFailure(f"executable '{name}' of package '{package}' is not built")
        return str(wrapper_script(command))


@expose_substitution("param")
class Parameter(Substitution):
    """A parameter that `SetParameter` has set, as a text.

    Attributes:
        name: the parameter's name.
    """

    def __init__(self, name: SomeSubstitutionsType, *, default: Any = None) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(name)
        self.__default = None if default is None else _texts(default)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``$(param NAME DEFAULT)``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("param substitution expects 1 or 2 arguments")
        return cls, dict(zip(("name", "default"), data, strict=False))

    def describe(self) -> str:
        """Return a text for people."""
        return f"Parameter(name={described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: nothing has set it, and there is no default.
        """
        name = perform_substitutions(context, self.name)
        shared: Any = context.launch_configurations.get("global_params") or ()
        for one in shared:
            if isinstance(one, tuple) and one[0] == name:
                return str(one[1])
        if self.__default is None:
            raise SubstitutionFailure(f"parameter '{name}' not found")
        return perform_substitutions(context, self.__default)


def _texts(default: Any) -> list[Substitution]:
    is_many = isinstance(default, Iterable) and not isinstance(default, str)
    items: Iterable[Any] = default if is_many else (default,)
    parts = [one if isinstance(one, str | Substitution) else str(one) for one in items]
    return normalize_to_list_of_substitutions(parts)
