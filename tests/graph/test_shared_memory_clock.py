from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.graph import shared_memory_clock
from gazelle.graph.shared_memory_clock import ClockPage, PageView


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ClockPage:
    monkeypatch.setattr(shared_memory_clock, "_folders", lambda: [tmp_path])
    return ClockPage()


def test_a_view_shows_what_the_page_shows(page: ClockPage) -> None:
    view = PageView(page.path, page.secret)
    assert view.read() == (0, 0, 0)
    assert not page.show(5)
    assert view.read() == (5, 0, 0)
    assert PageView(page.path, page.secret).read() == (5, 0, 0)


def test_time_that_goes_back_is_counted(page: ClockPage) -> None:
    view = PageView(page.path, page.secret)
    assert [page.show(one) for one in (10, 3, 4, 1)] == [False, True, False, True]
    assert view.read() == (1, 2, -3)


def test_times_since_1970_and_before_zero_fit(page: ClockPage) -> None:
    view = PageView(page.path, page.secret)
    for now_ns in (1_900_000_000_000_000_000, -5):
        page.show(now_ns)
        assert view.read()[0] == now_ns
    assert view.read()[2] == -1_900_000_000_000_000_005


def test_half_a_change_is_not_seen(page: ClockPage) -> None:
    view = PageView(page.path, page.secret)
    page.show(10)
    assert view.read() == (10, 0, 0)
    page._integers[0] = 20
    assert view.read() == (10, 0, 0)
    page._integers[0] = 10
    page.show(21)
    assert view.read() == (21, 0, 0)


def test_only_its_user_can_read_it(page: ClockPage, monkeypatch: pytest.MonkeyPatch) -> None:
    assert os.name != "posix" or Path(page.path).stat().st_mode & 0o777 == 0o600
    monkeypatch.setattr(os, "getuid", lambda: Path(page.path).stat().st_uid + 1, raising=False)
    with pytest.raises(OSError, match="not a clock of this user"):
        PageView(page.path, page.secret)


def test_another_file_is_not_taken_for_it(page: ClockPage, tmp_path: Path) -> None:
    with pytest.raises(OSError, match="another clock"):
        PageView(page.path, bytes(16))
    short = tmp_path / "short"
    short.write_bytes(b"GZclock1")
    with pytest.raises(OSError, match="not a clock"):
        PageView(str(short), page.secret)
    if hasattr(os, "O_NOFOLLOW"):
        (tmp_path / "link").symlink_to(page.path)
        with pytest.raises(OSError, match="link"):
            PageView(str(tmp_path / "link"), page.secret)


def test_a_closed_page_is_removed_and_keeps_its_last_time(page: ClockPage) -> None:
    view = PageView(page.path, page.secret)
    page.show(7)
    page.close()
    page.close()
    assert view.read() == (7, 0, 0)
    assert os.name == "nt" or not Path(page.path).exists()


@pytest.mark.skipif(os.name != "posix", reason="elsewhere files that are in use stay by themselves")
def test_what_a_killed_process_left_is_removed(page: ClockPage, tmp_path: Path) -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    left = tmp_path / f"gazelle-clock-{ended.pid}-abc"
    other = tmp_path / "gazelle-clock-of mine"
    for one in (left, other):
        one.touch()
    ClockPage()
    assert not left.exists()
    assert other.exists()
    assert Path(page.path).exists()


def test_without_a_folder_there_is_no_page(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shared_memory_clock, "_folders", list)
    with pytest.raises(OSError, match="no folder"):
        ClockPage()


def test_the_machine_has_one_name() -> None:
    assert bytes.fromhex(shared_memory_clock.machine_name())
    code = "from gazelle.graph.shared_memory_clock import machine_name; print(machine_name())"
    told = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert told.stdout.strip() == shared_memory_clock.machine_name()


def test_the_machine_has_a_name_where_the_kernel_gives_none(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(shared_memory_clock, "_BOOT", tmp_path / "nothing")
    assert bytes.fromhex(shared_memory_clock.machine_name.__wrapped__())
