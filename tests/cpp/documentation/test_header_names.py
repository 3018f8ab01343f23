"""What is read of a header: names for its users, and none of ours."""

from __future__ import annotations

from pathlib import Path

from gazelle.cpp.documentation import headers_markdown
from gazelle.cpp.header_names import names_in

_HEADER = """\
// class InComment {};
#ifndef SOME_HEADER_H
#define SOME_HEADER_H
#include <ros/ros.h>
#define SAY(...) \\
  do { class Hidden {}; } while (0)
#define GAZELLE_OWN 1
namespace robot {
class Forward;
class __attribute__((visibility("default"))) Arm final : public Forward {
  class Inner {};
  void move() { if (x) { int y; } }
};
template <class T, typename U = std::vector<T>>
struct Gripper {
};
template <>
struct Gripper<int> {};
enum class Mode { one, two };
using ArmPtr = std::shared_ptr<Arm>;
typedef boost::function<void(int)> Callback;
namespace detail { class Secret {}; void secret(int x); }
inline namespace v1 { double angle(const Arm& arm, double x = 1.0); }
inline bool ready(int x) { return true; }
bool operator==(const Arm& a, const Arm& b);
const char *text = "class InText {}; ";
void Arm::stop() {}
}  // namespace robot
#endif
"""


def test_names_of_a_header_are_those_that_users_write(tmp_path: Path) -> None:
    header = tmp_path / "some_header.h"
    header.write_text(_HEADER, encoding="utf-8")
    names = names_in(header)
    assert names.classes == (
        "robot::Arm", "robot::ArmPtr", "robot::Callback", "robot::Gripper", "robot::Mode",
    )  # fmt: skip
    assert names.functions == ("robot::angle", "robot::ready")
    assert names.macros == ("SAY",)
    assert names.includes == ("ros/ros.h",)


def test_classes_that_a_macro_makes_are_named(tmp_path: Path) -> None:
    header = tmp_path / "errors.hpp"
    header.write_text(
        "#define GAZELLE_ERROR(name) \\\n  class name : public E {}\n"
        "#define GAZELLE_SPACE errors\n"
        "namespace GAZELLE_SPACE {\nGAZELLE_ERROR(Late);\nGAZELLE_OTHER(None);\n}\n",
        encoding="utf-8",
    )
    assert names_in(header).classes == ("errors::Late",)


def test_page_has_a_row_for_a_header_and_the_names_that_only_include_it() -> None:
    page = headers_markdown()
    assert "| `ros/publisher.h` | `ros::Publisher`" in page
    assert "`urdf/model.hpp` (`urdf/model.h`)" in page
    assert "`gazebo_ros`" in page.partition("## Left out by name")[2]
