"""A substitution that stands for what a xacro file expands to."""

from pathlib import Path

from launch.frontend import expose_substitution
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

from gazelle.compat.moveit_configs import load_xacro


@expose_substitution("xacro")
class Xacro(Substitution):
    """The text of an expanded xacro file; path and arguments may be substitutions."""

    def __init__(self, file_path, *, mappings=None):
        super().__init__()
        self._file_path = normalize_to_list_of_substitutions(file_path)
        self._mappings = {} if mappings is None else mappings

    @classmethod
    def parse(cls, data):
        """Read ``$(xacro FILE)`` of an XML or YAML launch file."""
        if len(data) != 1:
            raise TypeError(
                "xacro takes one argument, the file; use $(command 'xacro FILE NAME:=VALUE') for"
                " arguments"
            )
        return cls, {"file_path": data[0]}

    @property
    def file_path(self):
        """What the path is put together of."""
        return self._file_path

    @property
    def mappings(self):
        """Arguments by name."""
        return self._mappings

    def describe(self):
        """Return the substitution as a text."""
        arguments = ", ".join(f"{name!s}:={value!s}" for name, value in self._mappings.items())
        return f"Xacro(file_path = {self._file_path}, mappings = {arguments})"

    def perform(self, context):
        """Return the expanded text."""
        arguments = {
            _performed(context, name): _performed(context, value)
            for name, value in self._mappings.items()
        }
        return load_xacro(Path(_performed(context, self._file_path)), mappings=arguments)


def _performed(context, value):
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))
