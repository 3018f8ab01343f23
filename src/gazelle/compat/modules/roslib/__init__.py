"""roslib, answered by Gazelle's workspace and interfaces."""

from gazelle.compat.roslib import load_manifest

from . import message, packages

__all__ = ["load_manifest", "message", "packages"]
