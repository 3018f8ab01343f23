"""launch_yaml, by Gazelle."""

import sys as _sys

from gazelle.launch.ros2 import launch_description_sources
from gazelle.launch.ros2.frontend import yaml as _yaml
from gazelle.launch.ros2.frontend.yaml import *  # noqa: F403

_FOLDER = f"{__name__}.launch_description_sources"
_sys.modules.update(
    {
        f"{__name__}.entity": _yaml,
        f"{__name__}.parser": _yaml,
        _FOLDER: launch_description_sources,
        f"{_FOLDER}.yaml_launch_description_source": launch_description_sources,
    }
)
