"""Headers of ``.cfg`` files."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cpp.interfaces import config_header
from gazelle.errors import UserFileError

_CFG = Path(__file__).parent / "definitions" / "Arm.cfg"


def test_a_class_has_the_parameters_of_its_file(tmp_path: Path) -> None:
    header = config_header(_CFG, "my_package", tmp_path / "include")
    assert header == tmp_path / "include/my_package/ArmConfig.h"
    text = header.read_text(encoding="utf-8")
    for line in (
        "namespace my_package {",
        "class ArmConfig {",
        "  int size{};",
        "  double gain{};",
        "  std::string name{};",
        "  bool on{};",
        "    class FINE_TUNING {",
        "    } fine_tuning;",
        "const int Arm_Large = 1;",
    ):
        assert f"{line}\n" in text, line
    assert '"How \\"large\\""' in text
    assert "offsetof(ArmConfig, gain), 0, 2u" in text
    assert "0.5, -infinity, infinity" in text
    assert "offsetof(ArmConfig, on), 1, 8u" in text


def test_a_program_that_fails_is_told_at_its_line(tmp_path: Path) -> None:
    cfg = tmp_path / "Arm.cfg"
    cfg.write_text("import math\nmath.sqroot(2)\n", encoding="utf-8")
    with pytest.raises(UserFileError) as error:
        config_header(cfg, "my_package", tmp_path)
    (found,) = error.value.diagnostics
    assert (found.code, found.span.line) == ("interfaces.config-program", 2)
    assert "sqroot" in found.message


def test_a_program_that_generates_nothing_is_told(tmp_path: Path) -> None:
    cfg = tmp_path / "Arm.cfg"
    cfg.write_text("x = 1\n", encoding="utf-8")
    with pytest.raises(UserFileError, match="does not call generate"):
        config_header(cfg, "my_package", tmp_path)
