"""``CMakeLists.txt`` and C++ sources of new packages of ROS 2 and of plain CMake."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = [
    "ament_lists",
    "cmake_config",
    "cmake_lists",
    "library_header",
    "library_source",
    "node_source",
    "visibility_header",
]

_HEAD = """cmake_minimum_required(VERSION 3.8)
project({0})

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()
"""
_NO_DEPENDS = """# What the package needs is named here, one line each:
# find_package(<dependency> REQUIRED)
"""
_INCLUDES = """target_include_directories({target} PUBLIC
  $<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>
  $<INSTALL_INTERFACE:include/${{PROJECT_NAME}}>)
target_compile_features({target} PUBLIC c_std_99 cxx_std_17)
"""
_LIBRARY = """
add_library({library} src/{library}.cpp)
add_library({name}::{library} ALIAS {library})
target_compile_definitions({library} PRIVATE "{upper}_BUILDING_LIBRARY")
"""
_LIBRARY_INSTALL = """
install(
  DIRECTORY include/
  DESTINATION include/${{PROJECT_NAME}}
)
install(
  TARGETS {library}
  EXPORT export_${{PROJECT_NAME}}
  ARCHIVE DESTINATION lib
  LIBRARY DESTINATION lib
  RUNTIME DESTINATION bin
)
"""
_NODE_INSTALL = """
install(TARGETS {node}
  DESTINATION lib/${{PROJECT_NAME}})
"""
_TESTING = """
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  # Remove these two lines once the sources carry a license and lie in a git repository.
  set(ament_cmake_copyright_FOUND TRUE)
  set(ament_cmake_cpplint_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()
"""
_EXPORTS = """
ament_export_include_directories(
  "include/${{PROJECT_NAME}}"
)
ament_export_libraries(
  {library}
)
ament_export_targets(
  export_${{PROJECT_NAME}}
)
"""
_CONFIG_INSTALL = """
configure_file({name}Config.cmake.in
  "${{PROJECT_BINARY_DIR}}/{name}Config.cmake" @ONLY)
configure_file({name}ConfigVersion.cmake.in
  "${{PROJECT_BINARY_DIR}}/{name}ConfigVersion.cmake" @ONLY)
install(FILES
  "${{PROJECT_BINARY_DIR}}/{name}Config.cmake"
  "${{PROJECT_BINARY_DIR}}/{name}ConfigVersion.cmake"
  DESTINATION "share/${{PROJECT_NAME}}/cmake")
install(EXPORT export_${{PROJECT_NAME}}
  DESTINATION "share/${{PROJECT_NAME}}/cmake"
  FILE export_{name}.cmake)
"""


def node_source(package: str) -> str:
    """Return a program that prints a line."""
    return f"""#include <iostream>

int main(int, char **)
{{
  std::cout << "hello world {package} package" << std::endl;
  return 0;
}}
"""


def library_header(package: str, library: str) -> str:
    """Return the header of an empty class named after the library."""
    guard = f"{package.upper()}__{library.upper()}_HPP_"
    name = _class_name(library)
    return f"""#ifndef {guard}
#define {guard}

#include "{package}/visibility_control.h"

namespace {package}
{{

class {package.upper()}_PUBLIC {name}
{{
public:
  {name}();
  virtual ~{name}();
}};

}}  // namespace {package}

#endif  // {guard}
"""


def library_source(package: str, library: str) -> str:
    """Return the source of that class."""
    name = _class_name(library)
    return f"""#include "{package}/{library}.hpp"

namespace {package}
{{

{name}::{name}() = default;

{name}::~{name}() = default;

}}  // namespace {package}
"""


def visibility_header(package: str) -> str:
    """Return the header that marks what a shared library shows to others."""
    name = package.upper()
    return f"""#ifndef {name}__VISIBILITY_CONTROL_H_
#define {name}__VISIBILITY_CONTROL_H_

#if defined(_WIN32)
#  ifdef {name}_BUILDING_LIBRARY
#    define {name}_PUBLIC __declspec(dllexport)
#  else
#    define {name}_PUBLIC __declspec(dllimport)
#  endif
#else
#  define {name}_PUBLIC __attribute__((visibility("default")))
#endif

#endif  // {name}__VISIBILITY_CONTROL_H_
"""


def ament_lists(name: str, depends: Sequence[str], node: str, library: str) -> str:
    """Return the build file of an ``ament_cmake`` package.

    Args:
        name: of the package.
        depends: packages it finds and links.
        node: name of an executable, empty for none.
        library: name of a library, empty for none.
    """
    tools = ["ament_cmake", *(["ament_cmake_ros"] if library else [])]
    parts = [_HEAD.format(name), "\n# find dependencies\n", *_finds(tools)]
    parts += _finds(depends) or [_NO_DEPENDS]
    if library:
        parts += [_library(name, library), _INCLUDES.format(target=library)]
        parts += [_ament_links(library, depends), _LIBRARY_INSTALL.format(library=library)]
    if node:
        parts += [f"\nadd_executable({node} src/{node}.cpp)\n", _INCLUDES.format(target=node)]
        links = f"target_link_libraries({node} {library})\n"
        parts += [links if library else _ament_links(node, depends)]
        parts += [_NODE_INSTALL.format(node=node)]
    parts += [_TESTING, _EXPORTS.format(library=library) if library else "", "\nament_package()\n"]
    return "".join(parts)


def cmake_lists(name: str, depends: Sequence[str], node: str, library: str) -> str:
    """Return the build file of a plain CMake package; arguments as for `ament_lists`."""
    parts = [_HEAD.format(name), "\n# find dependencies\n", *(_finds(depends) or [_NO_DEPENDS])]
    if library:
        parts += [_library(name, library), _INCLUDES.format(target=library)]
        parts += [_cmake_links(library, depends), _LIBRARY_INSTALL.format(library=library)]
    if node:
        parts += [f"\nadd_executable({node} src/{node}.cpp)\n", _INCLUDES.format(target=node)]
        parts += [_cmake_links(node, [library] if library else depends)]
        target = f"{node}\n  EXPORT export_${{PROJECT_NAME}}"
        parts += [_NODE_INSTALL.format(node=target)]
    if node or library:
        parts += [_CONFIG_INSTALL.format(name=name)]
    return "".join(parts)


def cmake_config(name: str, library: str) -> dict[str, str]:
    """Return the templates of a plain CMake package's config files, by ending of their names."""
    config = f'include("${{CMAKE_CURRENT_LIST_DIR}}/export_{name}.cmake")\n'
    if library:
        config += f"set({name}_LIBRARIES {name}::{library})\n"
    version = 'set(PACKAGE_VERSION "0.0.0")\n'
    version += 'if("${PACKAGE_FIND_VERSION}" VERSION_GREATER "${PACKAGE_VERSION}")\n'
    version += "  set(PACKAGE_VERSION_COMPATIBLE FALSE)\nelse()\n"
    version += "  set(PACKAGE_VERSION_COMPATIBLE TRUE)\nendif()\n"
    return {"Config.cmake.in": config, "ConfigVersion.cmake.in": version}


def _class_name(library: str) -> str:
    return "".join(part.title() for part in library.split("_"))


def _library(name: str, library: str) -> str:
    return _LIBRARY.format(name=name, library=library, upper=name.upper())


def _finds(names: Sequence[str]) -> list[str]:
    return [f"find_package({name} REQUIRED)\n" for name in names]


def _ament_links(target: str, depends: Sequence[str]) -> str:
    if not depends:
        return ""
    names = "".join(f'  "{name}"\n' for name in depends)
    return f"ament_target_dependencies(\n  {target}\n{names})\n"


def _cmake_links(target: str, names: Sequence[str]) -> str:
    return f"target_link_libraries({target} {' '.join(names)})\n" if names else ""
