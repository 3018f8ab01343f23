"""Files that ``configure_file()`` makes of templates, in packages that were never built."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.workspace.share_folder import share_folder

TEMPLATE = '<robot name="@PROJECT_NAME@">@WINGS@${colour}</robot>\n'
LISTS = """project(ibis)
option(HAS_WINGS "flies" ON)
option(IS_OLD "" OFF)
set(PARTS tail)
if(HAS_WINGS)
  list(APPEND PARTS left right)
endif()
if(NOT IS_OLD)
  list(APPEND PARTS beak)
else()
  list(APPEND PARTS stick)
endif()
set(WINGS)
foreach(PART ${PARTS})
  set(WINGS "${WINGS}<${PART} />")
endforeach()
"""
TEXT = '<robot name="ibis"><tail /><left /><right /><beak />${colour}</robot>\n'
INTO_SOURCE = "configure_file(ibis.xacro.in ${PROJECT_SOURCE_DIR}/urdf/ibis.xacro @ONLY)\n"
INTO_BUILD = """configure_file(ibis.xacro.in %s @ONLY)
install(FILES %s DESTINATION share/${PROJECT_NAME}/urdf)
"""


@pytest.fixture
def ibis(make_package, tmp_path: Path) -> Path:
    folder: Path = make_package(tmp_path / "ws" / "src" / "ibis", "ibis")
    (folder / "ibis.xacro.in").write_text(TEMPLATE)
    return folder


def shared(folder: Path, lists: str, *, has_devel_space: bool = True) -> Path:
    (folder / "CMakeLists.txt").write_text(lists)
    return share_folder(folder, "ibis", has_devel_space=has_devel_space)


def test_a_file_made_in_the_source_folder_is_in_the_share_folder(ibis: Path) -> None:
    share = shared(ibis, LISTS + INTO_SOURCE)
    assert (share / "urdf/ibis.xacro").read_text() == TEXT
    assert (share / "ibis.xacro.in").samefile(ibis / "ibis.xacro.in")
    assert not (ibis / "urdf").exists()


@pytest.mark.parametrize("has_devel_space", [True, False])
@pytest.mark.parametrize(
    ("output", "installed"),
    [
        ("ibis.xacro", "${CMAKE_CURRENT_BINARY_DIR}/ibis.xacro"),
        ("${PROJECT_BINARY_DIR}/a/ibis.xacro", "${CMAKE_BINARY_DIR}/a/ibis.xacro"),
    ],
)
def test_a_file_made_in_the_build_folder_is_where_it_is_installed(
    ibis: Path, output: str, installed: str, has_devel_space: bool
) -> None:
    lists = LISTS + INTO_BUILD % (output, installed)
    share = shared(ibis, lists, has_devel_space=has_devel_space)
    assert (share / "urdf/ibis.xacro").read_text() == TEXT


def test_a_subfolder_makes_its_own_files(ibis: Path) -> None:
    (ibis / "urdf").mkdir()
    (ibis / "ibis.xacro.in").rename(ibis / "urdf/ibis.xacro.in")
    (ibis / "urdf/CMakeLists.txt").write_text(LISTS + INTO_SOURCE)
    share = shared(ibis, "project(ibis)\nadd_subdirectory(urdf)\n")
    assert (share / "urdf/ibis.xacro").read_text() == TEXT


def test_a_changed_template_makes_another_file(ibis: Path) -> None:
    first = shared(ibis, LISTS + INTO_SOURCE)
    (ibis / "ibis.xacro.in").write_text("@PROJECT_NAME@\n")
    share_folder.cache_clear()
    from gazelle.workspace import installed_files

    installed_files._made.cache_clear()
    second = shared(ibis, LISTS + INTO_SOURCE)
    assert (second / "urdf/ibis.xacro").read_text() == "ibis\n"
    assert first != second


def test_what_a_build_has_left_there_stays(ibis: Path) -> None:
    (ibis / "urdf").mkdir()
    (ibis / "urdf/ibis.xacro").write_text("built\n")
    share = shared(ibis, LISTS + INTO_SOURCE)
    assert (share / "urdf/ibis.xacro").read_text() == "built\n"


@pytest.mark.parametrize(
    ("lists", "template"),
    [
        ("project(ibis)\n", "@FOUND_BY_CMAKE@"),
        ("project(ibis)\nif(UNIX)\n  set(X 1)\nelse()\n  set(X 2)\nendif()\n", "@X@"),
        ("project(ibis)\n", "#cmakedefine HAVE_X\n"),
    ],
    ids=["a variable that is found", "an if that is not decided", "a header"],
)
def test_what_only_cmake_knows_is_not_guessed(ibis: Path, lists: str, template: str) -> None:
    (ibis / "ibis.xacro.in").write_text(template)
    assert not (shared(ibis, lists + INTO_SOURCE) / "urdf/ibis.xacro").exists()


@pytest.mark.parametrize(
    ("words", "template", "text"),
    [
        ("COPYONLY", "@PROJECT_NAME@", "@PROJECT_NAME@"),
        ("", "@PROJECT_NAME@ ${PROJECT_NAME}", "ibis ibis"),
        ("@ONLY ESCAPE_QUOTES", "@Q@", r"a \"b\""),
    ],
)
def test_the_calls_options_count(ibis: Path, words: str, template: str, text: str) -> None:
    (ibis / "ibis.xacro.in").write_text(template)
    lists = 'project(ibis)\nset(Q "a \\"b\\"")\n' + INTO_SOURCE.replace("@ONLY", words)
    assert (shared(ibis, lists) / "urdf/ibis.xacro").read_text() == text
