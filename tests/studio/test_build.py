"""The committed page is what its sources give, and small enough."""

from __future__ import annotations

import gzip
import hashlib
import shutil
import subprocess
from pathlib import Path

import pytest
from tests.patience import stretched

_ROOT = Path(__file__).parents[2]
_SOURCES = _ROOT / "studio"
_PAGE = _ROOT / "src" / "gazelle" / "studio" / "page"
_VIEWER = _ROOT / "src" / "gazelle" / "studio" / "replay" / "viewer"
_MAX_BYTES = 500_000
# What the page is made of; vite.config.ts names the same.
_FILES = (
    "index.html",
    "package-lock.json",
    "tsconfig.json",
    "vite.config.ts",
    "vite.replay.config.ts",
)
_FOLDERS = ("src", "public")


def test_the_page_transfers_in_less_than_500_kb() -> None:
    sizes = {path.name: len(gzip.compress(path.read_bytes(), 6)) for path in _files(_PAGE)}
    assert sum(sizes.values()) <= _MAX_BYTES, sizes


def test_the_page_asks_nobody_else_for_anything() -> None:
    html = (_PAGE / "index.html").read_text()
    assert "http://" not in html
    assert "https://" not in html
    assert "<script>" not in html
    assert "onclick" not in html


def test_the_page_was_built_from_the_sources_that_are_there() -> None:
    built_from = (_PAGE / "built_from.txt").read_text(encoding="utf-8")
    assert built_from == f"sha256 {_digest()}\n", "run: cd studio && npm ci && npm run build"


def test_the_viewer_of_recordings_was_built_from_them_too_and_is_small() -> None:
    built_from = (_VIEWER / "built_from.txt").read_text(encoding="utf-8")
    assert built_from == f"sha256 {_digest()}\n", "run: cd studio && npm ci && npm run build"
    # Each replay carries it.
    assert len(gzip.compress((_VIEWER / "replay.js").read_bytes(), 9)) < 180_000


@pytest.mark.slow
def test_the_committed_page_is_what_its_sources_give(tmp_path: Path) -> None:
    if shutil.which("npm") is None:
        pytest.skip("npm is not installed")
    if not (_SOURCES / "node_modules" / ".bin" / "tsc").exists():
        pytest.skip("the page's packages are not installed (npm ci in studio/)")
    _npm("run", "check")
    _npm("exec", "--", "vite", "build", "--outDir", str(tmp_path / "page"), "--emptyOutDir")
    built = {path.relative_to(tmp_path / "page"): path for path in _files(tmp_path / "page")}
    committed = {path.relative_to(_PAGE): path for path in _files(_PAGE)}
    assert sorted(built) == sorted(committed)
    differing = [
        str(name)
        for name, path in built.items()
        if path.read_bytes() != committed[name].read_bytes()
    ]
    assert not differing, "run npm run build in studio/ and commit the page"


def _digest() -> str:
    below = (path for folder in _FOLDERS for path in _files(_SOURCES / folder))
    paths = {path.relative_to(_SOURCES).as_posix(): path for path in below}
    paths |= {name: _SOURCES / name for name in _FILES}
    found = hashlib.sha256()
    for name, path in sorted(paths.items()):
        text = path.read_text(encoding="utf-8").replace("\r\n", "\n")
        found.update(f"{name}\0{text}\0".encode())
    return found.hexdigest()


def _files(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.rglob("*")) if path.is_file()]


def _npm(*words: str) -> None:
    done = subprocess.run(
        ["npm", *words],
        cwd=_SOURCES,
        capture_output=True,
        text=True,
        timeout=stretched(300),
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
