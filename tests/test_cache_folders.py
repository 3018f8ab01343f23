"""Cache folders that are somebody else's, open, read-only, full or gone."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path

import pytest

from gazelle import announcements, cache_folders
from gazelle.cache_folders import is_trusted, is_usable, own_cache, own_folder, tell_not_kept

pytestmark = pytest.mark.skipif(os.name != "posix", reason="rights are the system's elsewhere")
needs_root = pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0, reason="only root gives files to others"
)


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    said: list[str] = []
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(announcements, "_process", [said.append])
    return said


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    (tmp_path / "tmp").mkdir()
    return tmp_path / "cache" / "gazelle"


def test_a_folder_is_made_for_the_user_alone(home: Path, told: list[str]) -> None:
    before = os.umask(0)
    try:
        assert own_cache("kernels") == home / "kernels"
    finally:
        os.umask(before)
    assert (home / "kernels").stat().st_mode & 0o777 == 0o700
    assert is_trusted(home / "kernels")
    assert told == []


def test_what_others_could_write_is_emptied_and_theirs_no_more(home: Path, told: list[str]) -> None:
    folder = home / "kernels"
    (folder / "sub").mkdir(parents=True)
    (folder / "planted").touch()
    folder.chmod(0o777)
    assert not is_trusted(folder)
    assert own_cache("kernels") == folder
    assert list(folder.iterdir()) == []
    assert is_trusted(folder)
    assert told == [
        f"others could write to '{folder}': it is emptied, and only this user's from now on"
    ]


@needs_root
def test_a_folder_of_another_user_is_passed_over_and_told_once(
    home: Path, tmp_path: Path, told: list[str]
) -> None:
    folder = home / "kernels"
    folder.mkdir(parents=True)
    os.chown(folder, 54321, 54321)
    spare = tmp_path / "tmp" / f"gazelle-cache-{os.getuid()}" / "kernels"
    assert own_cache("kernels") == spare
    assert own_cache("kernels") == spare
    assert told == [
        f"cannot use '{folder}': it belongs to user 54321, who could have put code there; "
        f"what belongs there is kept in '{spare}' for now\n"
        "  fix: name another folder by XDG_CACHE_HOME; each user has their own"
    ]


@needs_root
def test_a_spare_folder_that_another_user_made_first_is_not_used(
    home: Path, tmp_path: Path, told: list[str]
) -> None:
    for folder in (home / "kernels", tmp_path / "tmp" / f"gazelle-cache-{os.getuid()}"):
        folder.mkdir(parents=True)
        os.chown(folder, 54321, 54321)
    assert own_cache("kernels") is None
    assert "what belongs there is not kept, and made anew each time" in told[0]


def test_a_folder_that_cannot_be_made_is_told_with_the_reason(
    home: Path, told: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(folder: Path) -> None:
        raise OSError(errno.EROFS, "Read-only file system", str(folder))

    monkeypatch.setattr(cache_folders, "_make", refused)
    assert not is_usable(home / "pieces")
    assert not is_usable(home / "xacro_maps")
    assert told == [
        f"cannot use '{home / 'pieces'}': Read-only file system; what belongs there is not kept, "
        "and made anew each time\n"
        "  fix: name another folder by XDG_CACHE_HOME (ls -ld shows whose it is)"
    ]


def test_a_folder_that_a_variable_names_is_left_as_it_is(tmp_path: Path, told: list[str]) -> None:
    folder = tmp_path / "shared"
    folder.mkdir()
    folder.chmod(0o777)
    assert own_folder(folder, "GAZELLE_KERNEL_CACHE") is None
    assert folder.stat().st_mode & 0o777 == 0o777
    assert told == [
        f"cannot use '{folder}', which GAZELLE_KERNEL_CACHE names: others may write to it, who "
        f"could put code there\n"
        f"  fix: chmod go-w '{folder}', or let GAZELLE_KERNEL_CACHE name another folder"
    ]


def test_a_full_disk_is_told_once_with_what_to_do(tmp_path: Path, told: list[str]) -> None:
    full = OSError(errno.ENOSPC, "No space left on device")
    tell_not_kept("compiled kernels", tmp_path, full)
    tell_not_kept("compiled kernels", tmp_path, full)
    assert told == [
        f"cannot keep compiled kernels in '{tmp_path}': No space left on device; they are made "
        "anew each time\n  fix: make some room there, or name another folder by XDG_CACHE_HOME"
    ]


def test_a_folder_that_was_removed_is_made_again(home: Path, told: list[str]) -> None:
    assert own_cache("kernels")
    shutil.rmtree(home)
    assert is_usable(home / "kernels")
    assert told == []
