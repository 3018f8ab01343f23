"""What only its user knows."""

from __future__ import annotations

import os
import stat
import threading
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError
from gazelle.studio.security import VARIABLE, Secret, secret_of_user

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="users have numbers on POSIX")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user's folder for what programs remember, empty."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state" / "gazelle"


@posix
def test_secret_is_made_once_and_for_its_user_alone(home: Path) -> None:
    first = secret_of_user()
    assert first == secret_of_user()
    assert first.path == home / "secret"
    assert stat.S_IMODE(first.path.stat().st_mode) == 0o600
    assert stat.S_IMODE(home.stat().st_mode) == 0o700
    assert len(first.password) == 64
    assert [one.name for one in home.iterdir()] == ["secret"]


def test_processes_that_start_together_have_one_secret(home: Path) -> None:
    found: list[Secret] = []
    begin = threading.Barrier(8)

    def look() -> None:
        begin.wait(stretched())
        found.append(secret_of_user())

    threads = [threading.Thread(target=look) for _ in range(8)]
    for one in threads:
        one.start()
    for one in threads:
        one.join(stretched())
    assert len(found) == 8
    assert len({*found}) == 1


@posix
def test_secret_that_others_could_read_is_closed_to_them(home: Path) -> None:
    path = secret_of_user().path
    path.chmod(0o644)
    secret_of_user()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


@posix
def test_secret_that_is_shared_on_purpose_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "team"
    monkeypatch.setenv(VARIABLE, str(path))
    made = secret_of_user()
    assert made.path == path
    path.chmod(0o640)
    assert secret_of_user() == made
    path.chmod(0o644)
    with pytest.raises(GraphError, match=r"everybody can read .*\n  fix: chmod o= "):
        secret_of_user()


@pytest.mark.parametrize("text", ["", "nothing", ":", "a:", ":b", "a:b\nc:d"])
def test_what_is_no_secret_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    path = tmp_path / "team"
    path.write_text(text)
    path.chmod(0o600)
    monkeypatch.setenv(VARIABLE, str(path))
    with pytest.raises(GraphError, match=r"is no secret, one line of name:password\n"):
        secret_of_user()


def test_file_that_cannot_be_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "file" / "secret"))
    with pytest.raises(GraphError, match=rf"^{VARIABLE}=.*\n  fix: name a file"):
        secret_of_user()


def test_without_a_home_the_secret_is_in_a_folder_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path))
    made = secret_of_user()
    assert made.path.parent.parent == tmp_path
    assert stat.S_IMODE(made.path.parent.stat().st_mode) == 0o700
