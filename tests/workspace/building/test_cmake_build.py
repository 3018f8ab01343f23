"""Packages with a ``CMakeLists.txt``: data is installed, compiled code is named."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.plan import site_packages

Make = Callable[..., Path]
Build = Callable[..., dict[str, Outcome]]

_LISTS = """cmake_minimum_required(VERSION 3.8)
project(bot)
find_package(ament_cmake REQUIRED)
add_executable(driver src/driver.cpp src/other.cpp)
add_library(bot::core ALIAS core)
rosidl_generate_interfaces(${PROJECT_NAME} "msg/Level.msg" DEPENDENCIES std_msgs)
ament_python_install_package(${PROJECT_NAME})
install(PROGRAMS scripts/walk.py DESTINATION lib/${PROJECT_NAME} RENAME walk)
install(DIRECTORY launch urdf/ DESTINATION share/${PROJECT_NAME} PATTERN "*.bak" EXCLUDE)
install(TARGETS driver DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
_FILES = {
    "CMakeLists.txt": _LISTS,
    "src/driver.cpp": "int main() {}",
    "msg/Level.msg": "float64 level\n",
    "bot/__init__.py": "",
    "scripts/walk.py": "#!/usr/bin/env python3\nprint('walking')\n",
    "launch/bot.launch.py": "",
    "launch/bot.launch.py.bak": "",
    "urdf/bot.urdf": "<robot name='bot'/>",
}


@pytest.mark.parametrize("symlinks", [False, True])
def test_rules_are_followed_and_compiled_code_is_named(
    make: Make, build: Build, tmp_path: Path, symlinks: bool
) -> None:
    folder = make("bot", files=_FILES, needs=("std_msgs",))
    outcome = build(symlinks=symlinks)["bot"]
    assert outcome.code == 0
    (told,) = outcome.errors
    assert f"{folder}/CMakeLists.txt:4:1" in told
    assert "executable 'driver' (src/driver.cpp, src/other.cpp) of package 'bot'" in told
    assert "[build.compiled-target]" in told
    prefix = tmp_path / "install/bot"
    share = prefix / "share/bot"
    assert (share / "launch/bot.launch.py").is_symlink() == symlinks
    assert (share / "bot.urdf").is_file()
    assert not (share / "launch/bot.launch.py.bak").exists()
    assert (share / "msg/Level.msg").read_text() == "float64 level\n"
    assert (prefix / site_packages() / "bot/__init__.py").is_file()
    index = prefix / "share/ament_index/resource_index"
    assert (index / "packages/bot").read_text() == ""
    assert (index / "package_run_dependencies/bot").read_text() == "std_msgs"
    assert (index / "rosidl_interfaces/bot").read_text() == "msg/Level.msg\n"


def test_a_program_is_executable_and_data_is_not(make: Make, build: Build, tmp_path: Path) -> None:
    folder = make("bot", files=_FILES)
    (folder / "launch/bot.launch.py").chmod(0o755)
    build()
    prefix = tmp_path / "install/bot"
    assert os.access(prefix / "lib/bot/walk", os.X_OK)
    assert not (prefix / "share/bot/launch/bot.launch.py").stat().st_mode & 0o111


def test_a_second_build_changes_nothing(make: Make, build: Build, tmp_path: Path) -> None:
    make("bot", files=_FILES)
    build()
    before = {p: p.lstat().st_mtime_ns for p in (tmp_path / "install/bot").rglob("*")}
    outcome = build()["bot"]
    after = {p: p.lstat().st_mtime_ns for p in (tmp_path / "install/bot").rglob("*")}
    assert before == after
    assert outcome.output
    assert all(line.startswith("-- Up-to-date: ") for line in outcome.output)


def test_a_file_gone_from_the_sources_goes_from_the_install_space(
    make: Make, build: Build, tmp_path: Path
) -> None:
    folder = make("bot", files=_FILES)
    build()
    foreign = tmp_path / "install/bot/share/bot/notes.txt"
    foreign.write_text("mine")
    (folder / "launch/bot.launch.py").unlink()
    lines = build()["bot"].output
    installed = tmp_path / "install/bot/share/bot/launch/bot.launch.py"
    assert f"-- Removing: {installed}" in lines
    assert not installed.parent.exists()
    assert foreign.read_text() == "mine"


def test_links_and_copies_take_turns_without_touching_the_sources(
    make: Make, build: Build, tmp_path: Path
) -> None:
    folder = make("bot", files=_FILES)
    sources = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    modules = tmp_path / "install/bot" / site_packages() / "bot"
    for symlinks in (True, False, True, False):
        if not symlinks:
            # Without its records a build must not write through the links of an earlier one.
            (tmp_path / "build/bot/install_manifest.txt").unlink(missing_ok=True)
        assert build(symlinks=symlinks)["bot"].code == 0
        assert modules.is_symlink() == symlinks
        assert (modules / "__init__.py").is_file()
    assert {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()} == sources


@pytest.mark.parametrize(
    ("lists", "code", "words"),
    [
        ("install(FILES a.txt DESTINATION share/bot)", "package.install-missing", "cannot find"),
        ("install(FILES a.txt", "package.cmake-syntax", "CMake stops here"),
        (
            "rosidl_generate_interfaces(bot msg/No.msg)",
            "package.message-missing",
            "lists 'msg/No.msg'",
        ),
    ],
)
def test_a_rule_that_cannot_be_met_fails_the_package(
    make: Make, build: Build, tmp_path: Path, lists: str, code: str, words: str
) -> None:
    make("bot", files={"CMakeLists.txt": f"project(bot)\n{lists}\nament_package()\n"})
    outcome = build()["bot"]
    assert outcome.code == 2
    assert words in outcome.errors[0]
    assert f"[{code}]" in outcome.errors[0]
    assert not (tmp_path / "install/bot").exists()


def test_an_optional_or_conditional_rule_may_miss_its_file(make: Make, build: Build) -> None:
    lists = "project(bot)\ninstall(FILES a.txt DESTINATION share/bot OPTIONAL)\n"
    lists += "if(WITH_B)\ninstall(FILES b.txt DESTINATION share/bot)\nendif()\nament_package()\n"
    make("bot", files={"CMakeLists.txt": lists})
    assert build()["bot"].code == 0


def test_a_destination_outside_of_the_prefix_is_refused(
    make: Make, build: Build, tmp_path: Path
) -> None:
    lists = "project(bot)\ninstall(FILES package.xml DESTINATION ../../../away)\nament_package()\n"
    make("bot", files={"CMakeLists.txt": lists})
    outcome = build()["bot"]
    assert "[package.install-place]" in outcome.errors[0]
    assert not (tmp_path / "away").exists()


def test_definitions_reach_the_file(make: Make, build: Build, tmp_path: Path) -> None:
    lists = 'project(bot)\nset(KIND "small" CACHE STRING "size")\n'
    lists += "install(FILES ${KIND}.yaml DESTINATION share/bot)\nament_package()\n"
    make("bot", files={"CMakeLists.txt": lists, "small.yaml": "", "big.yaml": ""})
    build(KIND="big")
    share = tmp_path / "install/bot/share/bot"
    assert (share / "big.yaml").exists()
    assert not (share / "small.yaml").exists()


def test_a_build_type_without_rules_fails_by_name(make: Make, build: Build) -> None:
    make("bot", "ament_cargo")
    outcome = build()["bot"]
    assert outcome.code == 2
    assert "No task extension to 'build' a 'ros.ament_cargo' package" in outcome.errors[0]
    assert "[build.unknown-type]" in outcome.errors[0]


def test_a_file_in_the_way_is_named(make: Make, build: Build, tmp_path: Path) -> None:
    make("bot", files={"CMakeLists.txt": "project(bot)\nament_package()\n"})
    (tmp_path / "install").write_text("a file")
    outcome = build()["bot"]
    assert outcome.code == 2
    assert "[build.cannot-write]" in outcome.errors[0]


def test_without_ament_package_the_marker_is_made_and_told(
    make: Make, build: Build, tmp_path: Path
) -> None:
    make("bot", files={"CMakeLists.txt": "project(bot)\n"})
    outcome = build()["bot"]
    assert outcome.code == 0
    assert "ament_package() is not called" in outcome.errors[0]
    assert (tmp_path / "install/bot/share/ament_index/resource_index/packages/bot").is_file()


def test_a_folder_with_files_of_others_is_not_replaced_by_a_link(
    make: Make, build: Build, tmp_path: Path
) -> None:
    make("bot", files=_FILES)
    modules = tmp_path / "install/bot" / site_packages() / "bot"
    modules.mkdir(parents=True)
    (modules / "mine.py").write_text("x = 1")
    outcome = build(symlinks=True)["bot"]
    assert "Directory not empty" in outcome.errors[-1]
    assert (modules / "mine.py").is_file()


def test_a_macro_that_makes_programs_is_named_where_it_is_called(make: Make, build: Build) -> None:
    lists = """project(bot)
function(program name)
  add_executable(${name} src/${name}.cpp)
  install(TARGETS ${name} DESTINATION lib/bot)
endfunction()
program(walk)
ament_environment_hooks("${ament_cmake_package_templates_ENVIRONMENT_HOOK_LIBRARY_PATH}")
ament_environment_hooks("${OWN_HOOKS}")
ament_package()
"""
    make("bot", files={"CMakeLists.txt": lists})
    outcome = build()["bot"]
    assert outcome.code == 0
    assert len(outcome.errors) == 2
    assert "CMakeLists.txt:6:1" in outcome.errors[0]
    assert "program(walk …) of package 'bot' makes compiled code" in outcome.errors[0]
    assert "'${OWN_HOOKS}' is known to CMake only" in outcome.errors[1]


def test_an_old_record_never_removes_sources_behind_a_link(
    make: Make, build: Build, tmp_path: Path
) -> None:
    folder = make("bot", files=_FILES)
    build(symlinks=True)
    record = tmp_path / "build/bot/install_manifest.txt"
    modules = tmp_path / "install/bot" / site_packages() / "bot"
    record.write_text(f"{record.read_text()}{modules}/__init__.py\n{tmp_path}/mine.txt\n")
    (tmp_path / "mine.txt").write_text("mine")
    assert build(symlinks=True)["bot"].code == 0
    assert (folder / "bot/__init__.py").is_file()
    assert (tmp_path / "mine.txt").is_file()
