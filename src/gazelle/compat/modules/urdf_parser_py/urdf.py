"""urdf_parser_py.urdf, by Gazelle."""

import urdf_parser_py.xml_reflection as xmlr  # noqa: F401
from gazelle.compat.urdf_parser_py.robot import *  # noqa: F403
from gazelle.compat.urdf_parser_py.shapes import *  # noqa: F403
from urdf_parser_py.xml_reflection.basics import *  # noqa: F403

verbose = True
