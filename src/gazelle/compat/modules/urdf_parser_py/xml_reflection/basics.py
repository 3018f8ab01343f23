"""urdf_parser_py.xml_reflection.basics, by Gazelle."""

from gazelle.compat.urdf_objects.xml_text import *  # noqa: F403
