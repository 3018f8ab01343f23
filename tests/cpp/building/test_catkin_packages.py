"""Packages of ROS 1 are built as catkin and rosbuild would, old files included."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from tests.cpp.building.conftest import Packages, manifest, needs_compiler

from gazelle.cpp.building.build import (
    build_package,
    ensure_all_built,
    ensure_built,
    ensure_library_built,
)
from gazelle.cpp.elf_file import is_node_file, needed_libraries
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace
from gazelle.workspace.building.compile_step import CompileRequest
from gazelle.workspace.building.packages import find_packages

pytestmark = [needs_compiler, pytest.mark.usefixtures("stub_runtime"), pytest.mark.slow(20)]

WORDS = {
    "words/package.xml": manifest("words", "catkin", "std_msgs", "message_generation"),
    "words/CMakeLists.txt": """
        cmake_minimum_required(VERSION 2.8.3)
        project(words)
        find_package(catkin REQUIRED COMPONENTS std_msgs message_generation)
        add_message_files(FILES Word.msg)
        generate_messages(DEPENDENCIES std_msgs)
        catkin_package(INCLUDE_DIRS include LIBRARIES ${PROJECT_NAME} not_there
                       CATKIN_DEPENDS std_msgs message_runtime)
        include_directories(include ${catkin_INCLUDE_DIRS})
        add_library(${PROJECT_NAME} src/words.cpp)
        add_dependencies(${PROJECT_NAME} ${PROJECT_NAME}_generate_messages_cpp)
        target_link_libraries(${PROJECT_NAME} ${catkin_LIBRARIES})
    """,
    "words/msg/Word.msg": "string text\n",
    "words/include/words/words.h": "#pragma once\nnamespace words { int count(); }\n",
    "words/src/words.cpp": "#include <words/words.h>\nint words::count() { return 3; }\n",
}
SPEAKER = {
    "speaker/package.xml": manifest("speaker", "catkin", "words", "roscpp"),
    "speaker/CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.0.2)
        project(speaker)
        find_package(catkin REQUIRED COMPONENTS roscpp words)
        find_package(Boost REQUIRED COMPONENTS system)
        catkin_package()
        include_directories(${catkin_INCLUDE_DIRS} ${Boost_INCLUDE_DIRS})
        add_executable(${PROJECT_NAME}_node src/speaker.cpp)
        set_target_properties(${PROJECT_NAME}_node PROPERTIES OUTPUT_NAME speak PREFIX "")
        add_dependencies(${PROJECT_NAME}_node ${catkin_EXPORTED_TARGETS})
        target_link_libraries(${PROJECT_NAME}_node ${catkin_LIBRARIES} ${Boost_LIBRARIES})
        add_executable(broken src/broken.cpp)
        install(TARGETS ${PROJECT_NAME}_node
                RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
    """,
    "speaker/src/speaker.cpp": (
        "#include <words/words.h>\nint main(int, char **) { return words::count(); }\n"
    ),
    "speaker/src/broken.cpp": "int main() { return nowhere; }\n",
}


def opened(top: Path) -> Workspace:
    return Workspace.discover(environ={}, cwd=top, extra=[top])


def codes(diagnostics: Diagnostics) -> list[str]:
    return [item.code for item in diagnostics]


def test_a_node_is_built_with_what_its_package_needs(packages: Packages) -> None:
    workspace, found = opened(packages(WORDS | SPEAKER)), Diagnostics()
    file = ensure_built(
        workspace.package("speaker"), "speak", workspace=workspace, diagnostics=found
    )
    assert codes(found) == []
    assert file is not None
    assert is_node_file(file)
    needed = dict(needed_libraries(file))
    assert needed["libwords.so"] is not None
    assert (needed["libwords.so"].parents[1] / "include" / "words" / "Word.h").is_file()


def test_what_does_not_compile_is_told_and_the_rest_is_there(packages: Packages) -> None:
    top = packages(WORDS | SPEAKER)
    workspace, found = opened(top), Diagnostics()
    package = workspace.package("speaker")
    files = ensure_all_built(
        [(package, "broken", None), (package, "speak", None), (package, "spaek", None)],
        workspace=workspace,
        diagnostics=found,
    )
    assert [*files] == [("speaker", "speak")]
    assert sorted(codes(found)) == ["cpp.compile-error", "cpp.no-target"]
    error = found.by_code("cpp.compile-error")[0]
    assert error.message.startswith("'nowhere' was not declared in this scope")
    assert error.span is not None
    assert error.span.file == str(top / "speaker" / "src" / "broken.cpp")
    assert (error.span.line, error.span.column) == (1, 21)
    assert "speak" in found.by_code("cpp.no-target")[0].fix


def test_a_library_is_found_by_its_name(packages: Packages) -> None:
    workspace, found = opened(packages(WORDS)), Diagnostics()
    file = ensure_library_built(
        workspace.package("words"), "words", workspace=workspace, diagnostics=found
    )
    assert codes(found) == []
    assert file is not None
    assert file.name == "libwords.so"


def test_an_unchanged_package_is_left_alone_and_a_change_is_seen(packages: Packages) -> None:
    top = packages(WORDS | SPEAKER)
    workspace = opened(top)

    def built() -> int:
        file = ensure_built(
            workspace.package("speaker"), "speak", workspace=workspace, diagnostics=Diagnostics()
        )
        assert file is not None
        return file.stat().st_mtime_ns

    first = built()
    assert built() == first
    source = top / "speaker" / "src" / "speaker.cpp"
    source.write_text("int main() { return 1; }\n", encoding="utf-8")
    assert built() != first


@pytest.mark.parametrize(
    ("lines", "code", "word"),
    [
        ("find_package(nonsense REQUIRED)", "cpp.missing-package", "nonsense"),
        ("no_such_command(x)", "cpp.configure-error", "no_such_command"),
        ("add_executable(absent src/absent.cpp)", "cpp.configure-error", "absent.cpp"),
    ],
)
def test_what_cmake_says_comes_with_its_line(
    packages: Packages, lines: str, code: str, word: str
) -> None:
    text = "cmake_minimum_required(VERSION 3.0.2)\nproject(one)\n"
    text += f"find_package(catkin REQUIRED COMPONENTS roscpp)\ncatkin_package()\n{lines}\n"
    top = packages({"one/package.xml": manifest("one"), "one/CMakeLists.txt": text})
    workspace, found = opened(top), Diagnostics()
    ensure_built(workspace.package("one"), "node", workspace=workspace, diagnostics=found)
    assert codes(found) == [code]
    assert word in found.by_code(code)[0].message
    span = found.by_code(code)[0].span
    assert span is not None
    assert Path(span.file).name == "CMakeLists.txt"
    assert span.line in (0, 5)


@pytest.mark.parametrize(
    ("source", "code", "word"),
    [
        ('#include "foo_msgs/Foo.h"\nint main() {}\n', "cpp.missing-header", "no package"),
        ("#include <opencv9/x.h>\n#include <gazebo/gazebo.hh>\nint main() {}\n", "", ""),
        ("int other(); int main() { return other(); }\n", "cpp.link-error", "other()"),
    ],
)
def test_one_line_of_ours_says_where_it_would_come_from(
    packages: Packages, source: str, code: str, word: str
) -> None:
    text = "cmake_minimum_required(VERSION 3.0.2)\nproject(one)\n"
    text += "find_package(catkin REQUIRED COMPONENTS roscpp)\nadd_executable(node src/node.cpp)\n"
    files = {"one/package.xml": manifest("one"), "one/CMakeLists.txt": text}
    workspace = opened(packages(files | {"one/src/node.cpp": source}))
    found = Diagnostics()
    file = ensure_built(workspace.package("one"), "node", workspace=workspace, diagnostics=found)
    assert file is None
    if code:
        assert codes(found) == [code]
        assert word in found.by_code(code)[0].message
    else:
        assert codes(found) == ["cpp.missing-header"]


GAZEBO = {
    "sim/package.xml": manifest("sim", "catkin", "roscpp", "gazebo_ros"),
    "sim/CMakeLists.txt": """
        cmake_minimum_required(VERSION 2.8.3)
        project(sim)
        add_compile_options(-std=c++11 -march=native)
        find_package(catkin REQUIRED COMPONENTS roscpp gazebo_ros)
        find_package(gazebo REQUIRED)
        set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} ${GAZEBO_CXX_FLAGS}")
        catkin_package(DEPENDS GAZEBO)
        link_directories(${GAZEBO_LIBRARY_DIRS})
        include_directories(include ${catkin_INCLUDE_DIRS} ${GAZEBO_INCLUDE_DIRS})
        add_library(sim_plugin src/plugin.cpp)
        target_link_libraries(sim_plugin ${catkin_LIBRARIES} ${GAZEBO_LIBRARIES})
        add_executable(drive src/drive.cpp)
        add_dependencies(drive ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
        target_link_libraries(drive ${catkin_LIBRARIES} ${GAZEBO_LIBRARIES})
        install(TARGETS drive sim_plugin
                RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}
                LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
    """,
    "sim/include/sim/plugin.h": "#include <gazebo/gazebo.hh>\n",
    "sim/src/plugin.cpp": '#include "sim/plugin.h"\nGZ_REGISTER_MODEL_PLUGIN(X)\n',
    "sim/src/drive.cpp": "int main() { auto one = 1; return one; }\n",
}


def test_a_plug_in_of_gazebo_is_left_out_and_the_node_beside_it_is_built(
    packages: Packages, tmp_path: Path
) -> None:
    top = packages(GAZEBO)
    (source,) = find_packages([top], Diagnostics())
    install = tmp_path / "install"
    request = CompileRequest(source, tmp_path / "build", tmp_path / "devel", install)
    said: list[str] = []
    compiled = build_package(request, said=said.append)
    assert compiled.code == 0, compiled.output
    told = "\n".join(compiled.errors)
    assert "cpp.target-left-out" in told
    assert "'sim_plugin' left out" in told
    assert "cpp.flag-left-out" in told
    assert "-march=native" in told
    assert is_node_file(tmp_path / "devel" / "lib" / "sim" / "drive")
    assert is_node_file(install / "lib" / "sim" / "drive")
    assert not (install / "lib" / "libsim_plugin.so").exists()
    assert any("Building CXX object" in line for line in said)


ROSBUILD = {
    "old/manifest.xml": '<package><depend package="roscpp"/><depend package="std_msgs"/></package>',
    "old/CMakeLists.txt": """
        cmake_minimum_required(VERSION 2.4.6)
        include($ENV{ROS_ROOT}/core/rosbuild/rosbuild.cmake)
        set(ROS_BUILD_TYPE RelWithDebInfo)
        rosbuild_init()
        set(EXECUTABLE_OUTPUT_PATH ${PROJECT_SOURCE_DIR}/bin)
        set(LIBRARY_OUTPUT_PATH ${PROJECT_SOURCE_DIR}/lib)
        rosbuild_genmsg()
        rosbuild_add_library(old_library src/library.cpp)
        rosbuild_add_boost_directories()
        rosbuild_link_boost(old_library thread)
        rosbuild_add_executable(old_node src/node.cpp)
        target_link_libraries(old_node old_library)
    """,
    "old/msg/Old.msg": "int32 number\n",
    "old/src/library.cpp": "int seven() { return 7; }\n",
    "old/src/node.cpp": "int seven(); int main() { return seven(); }\n",
}


def test_a_package_of_rosbuild_is_built(packages: Packages) -> None:
    top = packages(ROSBUILD)
    workspace, found = opened(top), Diagnostics()
    package = workspace.package("old")
    node = ensure_built(package, "old_node", workspace=workspace, diagnostics=found)
    library = ensure_library_built(package, "old_library", workspace=workspace, diagnostics=found)
    assert codes(found) == []
    assert node is not None
    assert library is not None
    assert not (top / "old" / "bin").exists(), "the sources stay as they are"


def test_sources_that_change_while_they_are_compiled_are_compiled_again(
    packages: Packages, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = "cmake_minimum_required(VERSION 3.0.2)\nproject(one)\n"
    text += "find_package(catkin REQUIRED COMPONENTS roscpp)\nadd_executable(node src/node.cpp)\n"
    files = {"one/package.xml": manifest("one"), "one/CMakeLists.txt": text}
    top = packages(files | {"one/src/node.cpp": "int main() { return 1; }\n"})
    source, mark = top / "one" / "src" / "node.cpp", tmp_path / "edited"
    compiler = tmp_path / "slow-c++"
    compiler.write_text(
        '#!/bin/sh\nc++ "$@" || exit 1\n'
        f"case \"$*\" in *'-c {source}'*) [ -e {mark} ] || "
        f"{{ touch {mark}; echo 'int main() {{ return 2; }} const char *now = \"the-later-one\";' "
        f"> {source}; }};; esac\n",
        encoding="utf-8",
    )
    compiler.chmod(0o755)
    monkeypatch.setenv("CXX", str(compiler))
    workspace, found = opened(top), Diagnostics()
    file = ensure_built(workspace.package("one"), "node", workspace=workspace, diagnostics=found)
    assert codes(found) == []
    assert mark.exists()
    assert file is not None
    assert b"the-later-one" in file.read_bytes()


def test_without_a_compiler_the_extra_is_named(
    packages: Packages, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gazelle.cpp.building import toolchain

    monkeypatch.setattr(toolchain, "_zig", lambda: None)
    workspace, found = opened(packages(WORDS)), Diagnostics()
    files = ensure_all_built(
        [(workspace.package("words"), "x", None)],
        workspace=workspace,
        diagnostics=found,
        environ={"PATH": ""},
    )
    assert files == {}
    assert codes(found) == ["cpp.no-compiler"]
    assert "gazelle-sim[cpp]" in found.by_code("cpp.no-compiler")[0].fix


def test_a_full_disk_is_named(packages: Packages, tmp_path: Path) -> None:
    full = tmp_path / "full-c++"
    full.write_text(
        "#!/bin/sh\ncase \"$*\" in *' -c '*words.cpp*) echo 'No space left on device' >&2; exit 1;;"
        ' esac\nexec c++ "$@"\n',
        encoding="utf-8",
    )
    full.chmod(0o755)
    workspace, found = opened(packages(WORDS)), Diagnostics()
    environ = {**os.environ, "CXX": str(full)}
    file = ensure_library_built(
        workspace.package("words"),
        "words",
        workspace=workspace,
        diagnostics=found,
        environ=environ,
    )
    assert file is None
    assert "cpp.no-room" in codes(found)


def test_a_full_disk_of_the_cache_is_named(
    packages: Packages, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("gazelle.cpp.building.cmake.write_settings", full)
    workspace, found = opened(packages(WORDS)), Diagnostics()
    library = ensure_library_built(
        workspace.package("words"), "words", workspace=workspace, diagnostics=found
    )
    assert library is None
    assert codes(found) == ["cpp.no-room"]
    assert "No space left on device" in found.by_code("cpp.no-room")[0].message
