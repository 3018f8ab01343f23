"""Codes of C++: compilers, what they said, and what is left out."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "cpp.no-compiler",
        "error",
        "There is nothing here that compiles C++",
        "C++ of packages is compiled on your machine by its C++ compiler, CMake and ninja; the "
        "extra brings all of them as wheels where the system has none.",
        "pip install 'gazelle-sim[cpp]'",
    ),
    Entry(
        "cpp.compile-error",
        "error",
        "A C++ source does not compile",
        "The compiler's own words stand above. What does not compile is not started; the rest of "
        "the launch is.",
        "correct the source at the place shown",
        "make: *** [all] Error 2",
    ),
    Entry(
        "cpp.missing-header",
        "error",
        "A C++ source includes a header that is nowhere",
        "Gazelle has headers of its own for the packages of ROS that nodes use; those of other "
        "libraries come with the system's packages, or with a package of the workspace.",
        "install the library that the header belongs to",
        "fatal error: No such file or directory",
    ),
    Entry(
        "cpp.missing-package",
        "error",
        "CMakeLists.txt asks for a package that is nowhere",
        "It is neither in the workspace nor among those that Gazelle brings, and the system's "
        "CMake finds none of its name.",
        "put the package into the workspace, or install it on this system",
        "Could not find a package configuration file provided by",
    ),
    Entry(
        "cpp.configure-error",
        "error",
        "CMake does not get through a package",
        "CMake's own words stand above.",
        "correct CMakeLists.txt at the place shown",
        "CMake Error",
    ),
    Entry(
        "cpp.link-error",
        "error",
        "A program or library of C++ does not link",
        "The linker's own words stand above: a function is declared and used, and nothing that is "
        "linked has it.",
        "add the library to target_link_libraries(), or the source to add_executable()",
        "undefined reference to",
    ),
    Entry(
        "cpp.target-left-out",
        "warning",
        "A target of C++ is left out",
        "It uses libraries that Gazelle stands in for and that are not here, such as Gazebo's. The "
        "targets beside it are built.",
        "nothing has to be done: Gazelle has a counterpart of its own for most of them",
    ),
    Entry(
        "cpp.flag-left-out",
        "info",
        "A flag of the compiler is left out",
        "-march=native makes programs that other machines cannot run and types that differ from "
        "those of the libraries they are linked with; -Werror was written for another compiler.",
        "nothing has to be done; -O2 and -O3 are kept",
        quiet=True,
    ),
    Entry(
        "cpp.no-target",
        "error",
        "A package's CMake makes no program of that name",
        "The program was named in CMakeLists.txt under a condition that does not hold here, or by "
        "something that only CMake knows.",
        "look at the names that add_executable() is given",
    ),
    Entry(
        "cpp.no-room",
        "error",
        "There is no room for what the compiler makes",
        "The disk of the cache or of the build folder is full. Nothing half made is kept.",
        "make some room there, or name another folder by XDG_CACHE_HOME",
        "No space left on device",
    ),
    Entry(
        "cpp.not-loaded",
        "error",
        "A compiled node cannot be loaded",
        "The system's loader says why above: a library that it was linked with is not there any "
        "more, or a function that it uses is in none of its libraries.",
        "build the package again, and link what has the function with target_link_libraries()",
        "error while loading shared libraries",
    ),
)
