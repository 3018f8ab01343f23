"""urdf_parser_py.xml_reflection, by Gazelle."""

from urdf_parser_py.xml_reflection import basics, core  # noqa: F401
from urdf_parser_py.xml_reflection.core import *  # noqa: F403
