"""roslib, answered by Gazelle's workspace and interfaces."""

from gazelle.compat.roslib import load_manifest

from . import message, names, packages

__all__ = ["load_manifest", "message", "names", "packages"]
