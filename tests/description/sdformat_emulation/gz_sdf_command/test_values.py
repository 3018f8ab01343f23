"""Values printed as each release prints them."""

from __future__ import annotations

import pytest

from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import Parameter
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    default_text,
    pose_of,
    printed_value,
)
from gazelle.description.sdformat_emulation.release import Release


def _printed(kind: str, text: str, release: Release, **limits: float) -> tuple[str | None, str]:
    console = Console(release)
    parameter = Parameter("x", kind, "0", required=False, **limits)
    found = printed_value(parameter, text, {}, console)
    return found, "".join(console.lines).partition("\033[0m ")[2]


@pytest.mark.parametrize(
    ("kind", "text", "printed"),
    [
        ("double", "0.30000000000000004", "0.3"),
        ("double", "1e16", "1e+16"),
        ("double", "12abc", "12"),
        ("int", "0x10", "16"),
        ("bool", "True", "1"),
        ("vector3", "1 2e-7 -1e-8", "1 0 -0"),
        ("color", "1 0 .33333333", "1 0 0.333333 1"),
        ("pose", "1 2 3 0 0 0", "1 2 3 0 -0 0"),
        ("pose", "0 0 0 0 1.5707963 0", "0 0 0 0 1.5708 0"),
        ("time", "1.5", "1 0"),
        ("string", "as it is", "as it is"),
    ],
)
def test_old_release_prints_six_digits(kind: str, text: str, printed: str) -> None:
    assert _printed(kind, text, Release.V9) == (printed, "")
    if text != "1.5":
        assert _printed(kind, text, Release.V12) == (text, "")


@pytest.mark.parametrize(
    ("kind", "text", "reason"),
    [
        ("double", "wide", "Invalid argument. Unable to set value [wide ] for key[x]."),
        ("int", "99999999999", "Out of range. Unable to set value [99999999999 ] for key[x]."),
        ("bool", "yes", "Invalid boolean value"),
        ("color", "1 2 0", "The value <x>1 2 0</x> is invalid."),
        ("vector3", "1 2", "Unknown error. Unable to set value [1 2 ] for key[x]"),
        ("pose", "1 2 3", "The value for //pose[@rotation_format='euler_rpy'] must have 6 values, "
         "but 3 were found instead in '1 2 3'."),
        ("pose", "0 0 inf 0 0 0", "Pose values must be finite."),
    ],
)  # fmt: skip
def test_refused_values_come_with_a_reason(kind: str, text: str, reason: str) -> None:
    assert _printed(kind, text, Release.V12) == (None, reason)


@pytest.mark.parametrize(
    ("text", "pose", "size"),
    [
        ("1", "1 0 0 0 -0 0", "1 0 0"),
        ("1 2 x 4 5 6", "1 2 0 0 -0 0", "1 2 0"),
        ("1 2 3 4", "1 2 3 -2.28319 -0 0", "1 2 3"),
    ],
)
def test_old_release_keeps_the_numbers_before_a_fault(text: str, pose: str, size: str) -> None:
    assert _printed("pose", text, Release.V9) == (pose, "")
    assert _printed("vector3", text, Release.V9) == (size, "")


def test_new_release_keeps_to_limits() -> None:
    found, reason = _printed("double", "7", Release.V12, most=6.5)
    assert found is None
    assert reason == "The value [7] is greater than the maximum allowed value of [6.5] for key [x]"
    assert _printed("double", "7", Release.V9, most=6.5) == ("7", "")


def test_default_is_spelled_as_specified_unless_the_element_is_there() -> None:
    parameter = Parameter("x", "double", ".1", required=False)
    assert default_text(parameter, Console(Release.V12)) == ".1"
    assert default_text(parameter, Console(Release.V12), as_typed=True) == "0.10000000000000001"
    assert default_text(parameter, Console(Release.V9)) == "0.1"


def test_pose_is_metres_and_radians() -> None:
    pose = pose_of("1 2 3 0 0 1.5707963267948966")
    assert pose.position_m == (1.0, 2.0, 3.0)
    assert pose.rotate((1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))
