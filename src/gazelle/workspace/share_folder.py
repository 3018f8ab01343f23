"""The share folder of a source package, as it would be after an installation.

User code joins paths to what ``get_package_share_directory``, ``$(find …)`` or ``rospack find``
answer. Where install rules move no file the source folder itself is the answer. Where they do, the
answer is a tree of links in the user's cache: each file at the place the rules give it, so that
any joined path leads to it, and nothing has to be built. What no rule names is there too, and what
``configure_file()`` of the build file makes of a template, as far as its variables are known.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path

from gazelle.cache_folders import is_usable
from gazelle.diagnostics.share_links import LINKS_FOLDER, SOURCE_LINK
from gazelle.documents.files import exists
from gazelle.user_folders import cache_folder

__all__ = ["share_folder"]

_PRUNED = frozenset({"__pycache__", "build", "devel", "install", "log", "node_modules", "venv"})
_KEPT = 256


@lru_cache(maxsize=256)
def share_folder(folder: Path, name: str, *, has_devel_space: bool) -> Path:
    """Return the folder that answers for ``share/<name>`` of a source package.

    Args:
        folder: of the package.
        name: of the package.
        has_devel_space: built by catkin, whose look-ups find the source folder's places too, and
            first.
    """
    from gazelle.workspace.installed_files import install_rules, installed_files, made_texts

    start = f"share/{name}/"
    texts = made_texts(folder, name)
    if not texts and not any(
        f"/{rule.destination}/".startswith(f"/{start}") for rule in install_rules(folder, name)
    ):
        return folder
    files = {
        target.removeprefix(start): source
        for target, source in installed_files(folder, name).items()
        if target.startswith(start)
    }
    moved = {
        relative: source
        for relative, source in files.items()
        if (not exists(folder / relative) if has_devel_space else folder / relative != source)
    }
    if not moved and not texts:
        return folder
    stay = {source for relative, source in files.items() if folder / relative == source}
    left_out = frozenset() if has_devel_space else frozenset(moved.values()) - stay
    links = {relative: folder / relative for relative in _places_below(folder)}
    links = {relative: source for relative, source in links.items() if source not in left_out}
    return _linked(folder, name, {**links, **moved}, texts)


def _places_below(folder: Path) -> Iterator[str]:
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(
            item for item in folders if item not in _PRUNED and not item.startswith(".")
        )
        for item in sorted(names):
            yield os.path.relpath(os.path.join(root, item), folder).replace(os.sep, "/")  # noqa: PTH118


def _linked(folder: Path, name: str, files: Mapping[str, Path], texts: Mapping[str, str]) -> Path:
    """Return the tree of links and texts for these places; made once, and never changed."""
    import hashlib

    rows = "\n".join(
        f"{relative}\t{source}" for relative, source in sorted({**files, **texts}.items())
    )
    digest = hashlib.sha256(f"{folder}\n{rows}".encode(errors="surrogateescape")).hexdigest()[:16]
    failure: OSError | None = None
    for top in _tops():
        made = top / digest
        if not is_usable(top):
            failure = PermissionError(f"'{top}' cannot be used")
            continue
        try:
            if not made.is_dir():
                _make(made, folder, name, files, texts)
        except OSError as error:
            failure = error
            continue
        return made / "share" / name
    raise OSError(f"cannot lay out the share folder of package '{name}': {failure}")


def _tops() -> Iterator[Path]:
    """Yield the folders for links: the cache, and one that can be written where it cannot."""
    yield cache_folder() / LINKS_FOLDER
    import tempfile

    yield Path(tempfile.gettempdir()) / f"user-{os.getuid()}" / "gazelle" / LINKS_FOLDER


def _make(
    made: Path, folder: Path, name: str, files: Mapping[str, Path], texts: Mapping[str, str]
) -> None:
    import tempfile

    made.parent.mkdir(parents=True, exist_ok=True)
    _forget_others(made.parent)
    with tempfile.TemporaryDirectory(
        dir=made.parent, prefix=".", ignore_cleanup_errors=True
    ) as new:
        share = Path(new) / made.name / "share" / name
        share.mkdir(parents=True)
        for relative, text in texts.items():
            file = share / relative
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        for relative, source in files.items():
            link = share / relative
            # A file where another rule wants a folder is a mistake that CMake's install tells.
            with contextlib.suppress(FileExistsError, NotADirectoryError):
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(source)
        (share.parents[1] / SOURCE_LINK).symlink_to(folder)
        try:
            share.parents[1].rename(made)
        except OSError:
            # Another process was quicker: its tree is the same.
            if not made.is_dir():
                raise


def _forget_others(top: Path) -> None:
    """Remove the oldest trees, and those whose package is gone."""
    import shutil

    trees = [item for item in top.iterdir() if not item.name.startswith(".")]
    trees.sort(key=lambda item: item.lstat().st_mtime, reverse=True)
    for index, tree in enumerate(trees):
        if index >= _KEPT or not exists(tree / SOURCE_LINK):
            shutil.rmtree(tree, ignore_errors=True)
