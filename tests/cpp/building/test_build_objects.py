"""Each file is compiled once for a content, whatever comes and goes meanwhile."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from tests.cpp.building.conftest import needs_compiler

from gazelle.cpp.building.errors import CppBuildError
from gazelle.cpp.building.objects import Job, compiled
from gazelle.cpp.building.toolchain import Toolchain, find_toolchain

pytestmark = needs_compiler


@pytest.fixture
def toolchain() -> Toolchain:
    return find_toolchain()


@pytest.fixture
def job(tmp_path: Path) -> Job:
    own, include = tmp_path / "own", tmp_path / "include"
    own.mkdir()
    include.mkdir()
    (include / "number.h").write_text("#define NUMBER 1\n", encoding="utf-8")
    (own / "file.c").write_text("#include <number.h>\nint it = NUMBER;\n", encoding="utf-8")
    return Job(own / "file.c", {"include": include, "own": own})


def test_the_same_content_is_compiled_once(job: Job, toolchain: Toolchain, tmp_path: Path) -> None:
    first = compiled(job, toolchain, tmp_path / "top")
    made = (first / "object.o").stat().st_mtime_ns
    job.source.touch()
    again = compiled(job, toolchain, tmp_path / "top")
    assert again == first
    assert (again / "object.o").stat().st_mtime_ns == made


def test_a_changed_header_makes_another_object_and_its_return_finds_the_first(
    job: Job, toolchain: Toolchain, tmp_path: Path
) -> None:
    header = job.roots["include"] / "number.h"
    first = compiled(job, toolchain, tmp_path / "top")
    header.write_text("#define NUMBER 22\n", encoding="utf-8")
    second = compiled(job, toolchain, tmp_path / "top")
    header.write_text("#define NUMBER 1\n", encoding="utf-8")
    third = compiled(job, toolchain, tmp_path / "top")
    assert second != first
    assert third == first


def test_headers_may_move_to_a_folder_of_another_name(
    job: Job, toolchain: Toolchain, tmp_path: Path
) -> None:
    first = compiled(job, toolchain, tmp_path / "top")
    moved = tmp_path / "moved"
    shutil.copytree(job.roots["include"], moved)
    other = replace(job, roots={**job.roots, "include": moved})
    assert compiled(other, toolchain, tmp_path / "top") == first


def test_old_versions_are_forgotten(job: Job, toolchain: Toolchain, tmp_path: Path) -> None:
    header = job.roots["include"] / "number.h"
    for number in range(7):
        header.write_text(f"#define NUMBER 1{number}\n", encoding="utf-8")
        place = compiled(job, toolchain, tmp_path / "top").parent
    kept = [folder for folder in place.iterdir() if not folder.name.startswith(".")]
    assert len(kept) == 4


def test_the_compilers_words_come_with_the_error(
    job: Job, toolchain: Toolchain, tmp_path: Path
) -> None:
    job.source.write_text("int it = nowhere;\n", encoding="utf-8")
    with pytest.raises(CppBuildError, match="nowhere") as error:
        compiled(job, toolchain, tmp_path / "top")
    assert not error.value.is_no_room


def test_a_full_disk_is_named_and_leaves_nothing(job: Job, tmp_path: Path) -> None:
    full = tmp_path / "full-cc"
    full.write_text(
        "#!/bin/sh\necho 'Fatal error: cannot write: No space left on device' >&2; exit 1\n",
        encoding="utf-8",
    )
    full.chmod(0o755)
    toolchain = replace(find_toolchain(), c_command=(str(full),))
    with pytest.raises(CppBuildError, match="the disk is full") as error:
        compiled(job, toolchain, tmp_path / "top")
    assert error.value.is_no_room
    assert [path.name for path in (tmp_path / "top").rglob("*") if path.is_file()] == [".lock"]
