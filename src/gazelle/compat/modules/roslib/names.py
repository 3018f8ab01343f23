"""roslib.names, by Gazelle."""

from gazelle.compat.roslib import (
    BASE_RESOURCE_NAME_LEGAL_CHARS_P,
    PRN_SEPARATOR,
    RESOURCE_NAME_LEGAL_CHARS_P,
    TYPE_SEPARATOR,
    is_legal_resource_base_name,
    is_legal_resource_name,
    package_resource_name,
    resource_name,
    resource_name_base,
    resource_name_package,
)
from gazelle.compat.rosgraph.names import *  # noqa: F403
