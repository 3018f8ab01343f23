"""launch_xml, by Gazelle."""

import sys as _sys

from gazelle.launch.ros2 import launch_description_sources
from gazelle.launch.ros2.frontend import xml as _xml
from gazelle.launch.ros2.frontend.xml import *  # noqa: F403

_FOLDER = f"{__name__}.launch_description_sources"
_sys.modules.update(
    {
        f"{__name__}.entity": _xml,
        f"{__name__}.parser": _xml,
        _FOLDER: launch_description_sources,
        f"{_FOLDER}.xml_launch_description_source": launch_description_sources,
    }
)
