"""What was compiled is kept, taken where nothing of it has changed, and never of strangers."""

from __future__ import annotations

import errno
import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.kernels.kept_modules import Found, Modules
from tests.patience import stretched

from gazelle.kernels import areas, kept_code

_TWICE = """
from gazelle.kernels import kernel


@kernel
def f(x):
    return 2 * x
"""
needs_root = pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0, reason="only root gives files to others"
)
needs_no_root = pytest.mark.skipif(
    os.name != "posix" or os.geteuid() == 0, reason="root may write everywhere"
)
needs_rights = pytest.mark.skipif(os.name != "posix", reason="rights are the system's elsewhere")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache"
    folder.mkdir(mode=0o700)
    monkeypatch.setenv(kept_code.VARIABLE, str(folder))
    return folder


@pytest.fixture
def modules(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Modules]:
    made = Modules(tmp_path, monkeypatch)
    made.write(kernel=_TWICE)
    yield made
    made.forget()


def _file(folder: Path) -> Path:
    (file,) = folder.rglob("*.kernel")
    return file


# Loaded again


def test_another_process_loads_what_one_has_compiled(modules: Modules, tmp_path: Path) -> None:
    program = (
        "from gazelle.kernels import compiling\n"
        "import kernel\n"
        "with compiling(lambda source, _: print('compiled', source.name)):\n"
        "    print(kernel.f(2), kernel.f(2.5), kernel.f(2))\n"
    )
    said = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True,
            timeout=stretched(), check=True,
        )  # fmt: skip
        said.append(done.stdout.splitlines())
        assert done.stderr == ""
    compiled = "compiled kernel.f"
    assert said == [[compiled, compiled, "4 5.0 4"], ["4 5.0 4"]]


def test_each_kind_of_arguments_is_kept_by_itself(modules: Modules, cache: Path) -> None:
    assert modules.call(2) == Found(4, 1)
    assert modules.call(2.5) == Found(5.0, 1)
    assert modules.call(2) == Found(4, 0)
    assert modules.call(2.5) == Found(5.0, 0)
    assert len(list(cache.rglob("*.kernel"))) == 2


def test_what_a_kernel_returns_is_known_again(modules: Modules) -> None:
    modules.write(
        record=(
            "from typing import NamedTuple\nclass Pair(NamedTuple):\n    a: float\n    b: object\n"
        ),
        kernel=(
            "import numpy as np\nfrom gazelle.kernels import kernel\nfrom record import Pair\n"
            "@kernel\ndef f(x):\n    return Pair(x, (np.full(2, x), x > 0, None)), x\n"
        ),
    )
    for compiled in (1, 0):
        result, count, _ = modules.call(2.5)
        assert count == compiled
        assert type(result[0]).__name__ == "Pair"
        assert result[0].b[0].tolist() == [2.5, 2.5]
        assert (result[0].a, *result[0].b[1:], result[1]) == (2.5, True, None, 2.5)


def test_compiling_is_told_and_loading_is_not(
    modules: Modules, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(areas, "AREAS", (areas.Area("tested", "tests", 7),))
    modules.write(kernel=f"{_TWICE}\nf.source.function.__module__ = 'gazelle.tested.kernel'\n")
    assert modules.call(2).told == (
        "compiling the kernels of tests for this machine: up to 7 s of computing, once "
        "('gazelle warm' does it ahead)",
    )
    assert modules.call(2).told == ()


# Stale

_OTHER = """
import math
from typing import NamedTuple

import numpy as np

from gazelle.kernels import kernel

GAIN = 2
OFFSETS = (1.0, 2.0)
SCALE = 10.0
UNUSED = 7


class Pair(NamedTuple):
    a: float
    b: float


@kernel
def _inner(x):
    return x + 1


@kernel
def outer(x):
    return _inner(x) * SHARE


@kernel
def unused(x):
    return x


SHARE = 0.5
REAL = np.float32
TYPE = "int8"
root = math.sqrt
"""
_USER = """
import other
import numpy as np
from other import GAIN, OFFSETS, REAL, TYPE, Pair, outer, root

from gazelle.kernels import kernel

OWN = 100


@kernel
def f(x):
    pair = Pair(x, 3.0)
    single, small = np.full(1, 2.0**30 + 1.0, REAL), np.full(1, 257, TYPE)
    more = root(x) - 2.0 + other.root(x) - 2.0 + single[0] - 2.0**30 + small[0] - 1
    return outer(x) * GAIN + OFFSETS[1] + pair.a * 1000 + OWN + other.SCALE + more
"""
_CHANGES = [
    ("kernel", "OWN = 100", "OWN = 200", 100),
    ("kernel", "pair.a * 1000", "pair.a * 2000", 4000),
    ("other", "GAIN = 2", "GAIN = 4", 5),
    ("other", "OFFSETS = (1.0, 2.0)", "OFFSETS = (1.0, 4.0)", 2),
    ("other", "SCALE = 10.0", "SCALE = 20.0", 10),
    ("other", "SHARE = 0.5", "SHARE = 1", 5),
    ("other", "x + 1", "x + 3", 2),
    ("other", "_inner(x) * SHARE", "_inner(x) + SHARE", 6),
    ("other", "    a: float\n    b: float", "    b: float\n    a: float", -1000),
    ("other", "SCALE = 10.0", "SCALE = 10", 0),
    ("other", "REAL = np.float32", "REAL = np.float64", 1),
    ("other", 'TYPE = "int8"', 'TYPE = "int16"', 256),
    ("other", "root = math.sqrt", "root = float", 4),
]


def _described(modules: Modules) -> None:
    modules.write(other=_OTHER, kernel=_USER)
    assert modules.call(4.0) == Found(4117.0, 1)
    assert modules.call(4.0) == Found(4117.0, 0)


@pytest.mark.parametrize(("name", "before", "after", "more"), _CHANGES)
def test_a_kernel_is_compiled_anew_where_something_it_is_made_of_has_changed(
    modules: Modules, name: str, before: str, after: str, more: int
) -> None:
    _described(modules)
    modules.change(name, before, after)
    assert modules.call(4.0) == Found(4117.0 + more, 1)
    assert modules.call(4.0) == Found(4117.0 + more, 0)


def test_a_kernel_is_kept_where_nothing_it_is_made_of_has_changed(modules: Modules) -> None:
    _described(modules)
    modules.change("other", "UNUSED = 7", "UNUSED = 8\n# Everything below moves.\nMORE = 9")
    modules.change("other", "return x\n", "return x + 5\n")
    modules.change("other", "    return x + 1\n", "    # As before.\n    return x + 1\n")
    modules.change("kernel", "OWN = 100", "OWN = 50 * 2\n_LATER = 1")
    assert modules.call(4.0) == Found(4117.0, 0)


def test_a_kernel_is_compiled_anew_where_what_it_used_is_gone(modules: Modules) -> None:
    _described(modules)
    modules.change("other", "SHARE = 0.5", "PART = 0.5")
    modules.change("other", "* SHARE", "* PART")
    assert modules.call(4.0) == Found(4117.0, 1)


_RECORD = """
from typing import NamedTuple


class Inner(NamedTuple):
    a: float
    b: float


class Pair(NamedTuple):
    inner: Inner
"""
_READER = """
from gazelle.kernels import kernel
from record import Inner, Pair


@kernel
def read(pair):
    return pair.inner.a


def f():
    return read(Pair(Inner(a=1.0, b=2.0)))
"""


def test_a_kernel_is_compiled_anew_where_fields_of_its_arguments_have_another_order(
    modules: Modules,
) -> None:
    modules.write(record=_RECORD, kernel=_READER)
    assert [modules.call() for _ in range(2)] == [Found(1.0, 1), Found(1.0, 0)]
    modules.change("record", "    a: float\n    b: float", "    b: float\n    a: float")
    assert [modules.call() for _ in range(2)] == [Found(1.0, 1), Found(1.0, 0)]


def test_a_kernel_is_compiled_anew_where_the_class_of_an_argument_has_another_name(
    modules: Modules,
) -> None:
    modules.write(record=_RECORD, kernel=_READER)
    assert modules.call() == Found(1.0, 1)
    modules.write(record=_RECORD.replace("Pair", "Two"), kernel=_READER.replace("Pair", "Two"))
    assert modules.call() == Found(1.0, 1)


def test_what_another_llvm_or_processor_has_compiled_is_not_taken(
    modules: Modules, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gazelle.kernels import machine_code

    assert modules.call(2) == Found(4, 1)
    monkeypatch.setattr(machine_code, "machine", lambda: "another one")
    assert modules.call(2) == Found(4, 1)
    monkeypatch.undo()


# Damaged, full, gone

_GONE = b"cgazelle.kernels.kept_code\ngone\n."
_FEWER = b"cgazelle.kernels.kept_code\nKeptCode\n(S'only one'\ntR."


@pytest.mark.parametrize(
    "left",
    [
        b"",
        b"half",
        b"\x80\x05.",
        pickle.dumps(3),
        b"cgazelle.kernels.kept_code\nnothing_of_this_name\n.",
        None,
    ],
    ids=["empty", "words", "nothing", "a number", "a name that is gone", "half of it"],
)
def test_a_damaged_file_counts_as_not_there(
    modules: Modules, cache: Path, left: bytes | None
) -> None:
    assert modules.call(2) == Found(4, 1)
    content = _file(cache).read_bytes()
    _file(cache).write_bytes(content[: len(content) // 2] if left is None else left)
    assert modules.call(2) == Found(4, 1)
    assert modules.call(2) == Found(4, 0)


def test_on_a_full_disk_kernels_work_and_it_is_told_once(
    modules: Modules, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    modules.write(kernel=f"{_TWICE}\ntwice = f\n\ndef f():\n    return twice(2), twice(2.0)\n")
    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", refused)
        result, compiled, told = modules.call()
    assert (result, compiled) == ((4, 4.0), 2)
    (folder,) = cache.iterdir()
    assert told == (
        f"cannot keep compiled kernels in '{folder}': No space left on device; they are made anew "
        "each time\n  fix: make some room there, or let GAZELLE_KERNEL_CACHE name another folder",
    )
    assert not list(cache.rglob("*.kernel*"))


def test_a_folder_that_is_removed_while_running_is_made_again(
    modules: Modules, cache: Path
) -> None:
    module = modules.module()
    assert module.f(2) == 4
    shutil.rmtree(cache)
    assert module.f(2.5) == 5.0
    # What was kept before is gone.
    assert modules.call(2) == Found(4, 1)
    assert modules.call(2.5) == Found(5.0, 0)


# Whose folders


def test_the_folder_that_a_variable_names_is_made(
    modules: Modules, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(kept_code.VARIABLE, str(tmp_path / "some" / "where"))
    assert modules.call(2) == Found(4, 1)
    assert modules.call(2) == Found(4, 0)
    file = _file(tmp_path / "some" / "where")
    assert file.name.startswith("kernel.f-")
    if os.name == "posix":
        assert {folder.stat().st_mode & 0o777 for folder in (file.parent, file.parents[1])} == {
            0o700
        }


def _elsewhere(modules: Modules, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Call a kernel where its folder cannot be used, and return what is told."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "own"))
    result, compiled, told = modules.call(2)
    assert (result, compiled) == (4, 1)
    assert list((tmp_path / "own" / "gazelle" / "kernels").rglob("*.kernel"))
    assert modules.call(2) == Found(4, 0, told)
    (text,) = told
    return text


@needs_root
def test_nothing_is_loaded_from_a_folder_of_another_user(
    modules: Modules, cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert modules.call(2) == Found(4, 1)
    os.chown(cache, 54321, 54321)
    assert _elsewhere(modules, tmp_path, monkeypatch) == (
        f"cannot use '{cache}', which GAZELLE_KERNEL_CACHE names: it belongs to user 54321, who "
        "could have put code there\n"
        "  fix: let GAZELLE_KERNEL_CACHE name another folder; each user has their own"
    )


@needs_rights
def test_nothing_is_loaded_from_a_folder_that_others_may_write_to(
    modules: Modules, cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert modules.call(2) == Found(4, 1)
    cache.chmod(0o777)
    assert _elsewhere(modules, tmp_path, monkeypatch) == (
        f"cannot use '{cache}', which GAZELLE_KERNEL_CACHE names: others may write to it, who "
        "could put code there\n"
        f"  fix: chmod go-w '{cache}', or let GAZELLE_KERNEL_CACHE name another folder"
    )


@needs_no_root
def test_a_folder_that_cannot_be_written_is_told(
    modules: Modules, cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache.chmod(0o500)
    assert _elsewhere(modules, tmp_path, monkeypatch) == (
        f"cannot use '{cache}', which GAZELLE_KERNEL_CACHE names: it cannot be written\n"
        "  fix: let GAZELLE_KERNEL_CACHE name another folder (ls -ld shows whose it is)"
    )


def test_a_file_in_place_of_the_folder_is_told(
    modules: Modules, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv(kept_code.VARIABLE, str(tmp_path / "file" / "folder"))
    text = _elsewhere(modules, tmp_path, monkeypatch)
    assert text.startswith(
        f"cannot use '{tmp_path / 'file' / 'folder'}', which GAZELLE_KERNEL_CACHE names: "
    )


@needs_rights
def test_beside_a_module_kernels_are_kept_where_nobody_else_may_write(
    modules: Modules, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(kept_code.VARIABLE, "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "own"))
    beside = tmp_path / "__pycache__"
    beside.mkdir(mode=0o700)
    assert modules.call(2) == Found(4, 1)
    assert _file(beside)
    assert modules.call(2) == Found(4, 0)
    beside.chmod(0o777)
    assert modules.call(2) == Found(4, 1)
    assert _file(tmp_path / "own" / "gazelle" / "kernels")
    assert modules.call(2) == Found(4, 0)


def test_where_nothing_can_be_kept_kernels_are_compiled_each_time(
    modules: Modules, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kept_code, "own_folder", lambda *_: None)
    monkeypatch.setattr(kept_code, "own_cache", lambda _: None)
    for _ in range(2):
        assert modules.call(2) == Found(4, 1)
