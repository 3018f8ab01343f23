"""Files that Gazelle itself has saved carry a version; what a newer one saved is refused."""

from __future__ import annotations

__all__ = ["refused_version"]


def refused_version(what: str, version: object, known: int) -> str:
    """Return why a saved file is not read, empty for a version that is known.

    Args:
        what: names the file, such as ``the layout 'desk'``.
        version: as it stands in the file.
        known: the newest that this Gazelle reads; it reads the older ones, too.
    """
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        return f"{what} is of version {version!r}, which is none: versions are 1, 2, 3 …"
    if version <= known:
        return ""
    text = f"{what} is of version {version}, saved by a newer Gazelle; this one reads versions up "
    return text + f"to {known} (pip install --upgrade gazelle-sim)"
