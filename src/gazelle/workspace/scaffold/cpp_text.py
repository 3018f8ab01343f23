"""C++ sources of new packages; they are for a real build, Gazelle does not compile them."""

from __future__ import annotations

__all__ = ["library_header", "library_source", "node_source", "visibility_header"]


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


def _class_name(library: str) -> str:
    return "".join(part.title() for part in library.split("_"))
