"""C++ headers of messages, services, actions, ``.cfg`` files and parameter files."""

from __future__ import annotations

from gazelle.cpp.interfaces.config_headers import config_header
from gazelle.cpp.interfaces.header_trees import known_messages, package_messages
from gazelle.cpp.interfaces.parameter_headers import parameter_header

__all__ = ["config_header", "known_messages", "package_messages", "parameter_header"]
