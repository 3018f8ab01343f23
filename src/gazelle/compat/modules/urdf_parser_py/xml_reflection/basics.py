"""urdf_parser_py.xml_reflection.basics, by Gazelle."""

from gazelle.compat.urdf_parser_py.xml_text import *  # noqa: F403
