"""urdf_parser_py.xml_reflection.core, by Gazelle; programs may set on_error and skip_default."""

from gazelle.compat.urdf_parser_py.xml_reflection import *  # noqa: F403
from gazelle.compat.urdf_parser_py.value_types import *  # noqa: F403
from gazelle.compat.urdf_parser_py.value_types import on_error_stderr
from gazelle.compat.urdf_parser_py.xml_text import *  # noqa: F403

on_error = on_error_stderr
skip_default = False
value_type_prefix = ""
