"""Nothing half made is kept, and one process at a time makes a thing."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from tests.patience import eventually

from gazelle.cpp.building import cache as build_cache
from gazelle.cpp.building.cache import (
    cache_top,
    digest_of_file,
    make_whole,
    only_one,
    stat_signature,
)


def test_a_folder_gets_its_name_when_it_is_whole(tmp_path: Path) -> None:
    target = tmp_path / "thing"
    with make_whole(target) as made:
        (made / "file").write_text("x", encoding="utf-8")
        assert not target.exists()
    assert (target / "file").read_text(encoding="utf-8") == "x"


def test_nothing_is_left_where_the_disk_is_full(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No space"), make_whole(tmp_path / "thing") as made:
        (made / "half").write_text("x", encoding="utf-8")
        raise OSError(28, "No space left on device")
    assert not list(tmp_path.iterdir())


def test_who_comes_second_keeps_what_the_first_made(tmp_path: Path) -> None:
    target = tmp_path / "thing"
    with make_whole(target) as second:
        with make_whole(target) as first:
            (first / "by").write_text("first", encoding="utf-8")
        (second / "by").write_text("second", encoding="utf-8")
    assert (target / "by").read_text(encoding="utf-8") == "first"


def test_what_a_killed_process_left_is_removed(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as gone:
        gone.wait()
    left = tmp_path / f".new-{gone.pid}-abc"
    left.mkdir()
    with make_whole(tmp_path / "thing"):
        pass
    assert not left.exists()


def test_a_second_thread_waits_for_the_first(tmp_path: Path) -> None:
    order: list[str] = []
    holds, may_go = threading.Event(), threading.Event()

    def first() -> None:
        with only_one(tmp_path / "lock", "making"):
            holds.set()
            may_go.wait()
            order.append("first")

    def second() -> None:
        holds.wait()
        with only_one(tmp_path / "lock", "making"):
            order.append("second")

    threads = [threading.Thread(target=work) for work in (first, second)]
    for thread in threads:
        thread.start()
    holds.wait()
    may_go.set()
    for thread in threads:
        thread.join()
    assert order == ["first", "second"]


def test_a_second_process_waits_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code = (
        "import sys; from pathlib import Path\n"
        "from gazelle.cpp.building.cache import only_one\n"
        "with only_one(Path(sys.argv[1]), 'making a thing'): print('in', flush=True)"
    )
    with only_one(tmp_path / "lock", "making a thing"):
        other = subprocess.Popen(
            [sys.executable, "-c", code, str(tmp_path / "lock")],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert other.stderr is not None
        said = other.stderr.readline()
        assert "waiting for another process, which is making a thing" in said
        assert other.poll() is None
    out, _ = other.communicate()
    assert out == "in\n"


def test_a_digest_follows_the_content(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("one", encoding="utf-8")
    first = digest_of_file(file)
    file.write_text("two!", encoding="utf-8")
    assert digest_of_file(file) != first
    assert digest_of_file(tmp_path / "absent") == ""


def test_a_signature_tells_of_new_files(tmp_path: Path) -> None:
    before = stat_signature([tmp_path])
    (tmp_path / "file").touch()
    assert stat_signature([tmp_path]) != before


def test_without_any_cache_other_processes_get_this_ones(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    cache_top.cache_clear()
    monkeypatch.delenv("GAZELLE_CPP_CACHE", raising=False)
    monkeypatch.setattr(build_cache, "own_cache", lambda _: None)
    monkeypatch.setattr(build_cache.atexit, "register", lambda *_: None)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(build_cache.tempfile, "tempdir", str(tmp_path))
    try:
        top = cache_top()
        assert os.environ["GAZELLE_CPP_CACHE"] == str(top)
        cache_top.cache_clear()
        assert cache_top() == top
    finally:
        cache_top.cache_clear()
        os.environ.pop("GAZELLE_CPP_CACHE", None)


def test_the_lock_of_a_killed_process_is_free(tmp_path: Path) -> None:
    code = (
        "import os, sys; from pathlib import Path\n"
        "from gazelle.cpp.building.cache import only_one\n"
        "with only_one(Path(sys.argv[1]), 'x'):\n"
        "    print('in', flush=True); sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path / "lock")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "in\n"
        other.kill()
    entered = False
    with only_one(tmp_path / "lock", "x"):
        entered = True
    assert eventually(lambda: entered)
