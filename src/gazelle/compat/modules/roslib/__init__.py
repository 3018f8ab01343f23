"""roslib: what is left of it in programs is load_manifest, which has nothing to do here."""

__all__ = ["load_manifest"]


def load_manifest(package_name, bootstrap_version="0.7"):
    """Do nothing: packages of the workspace are importable as they are."""
