"""MuJoCo's warnings, those of compiling and those of stepping."""

from __future__ import annotations

import warnings

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.engine.mujoco_library import (
    compiled,
    drained_warnings,
    mujoco,
    report_library_warnings,
)

DEPRECATED = """<mujoco><compiler settotalmass="3"/><worldbody><body name="b"><freejoint/>
<geom size=".1" mass="1"/></body></worldbody></mujoco>"""


def test_what_compiling_warns_of_is_no_warning_of_python(
    recwarn: pytest.WarningsRecorder, capfd: pytest.CaptureFixture[str]
) -> None:
    for _ in range(2):
        warnings.simplefilter("always")
        model = compiled(mujoco.MjSpec.from_string(DEPRECATED))
        assert model.nbody == 2
        (text,) = drained_warnings()
        assert text.startswith("compiler attribute 'settotalmass' is deprecated")
    assert not recwarn.list
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("words", "subject"),
    [
        ("Inertia matrix is too close to singular at DOF 0. Check model.", "joint 'joint'"),
        ("mass of 'arm::rod' is small", "link 'rod'"),
        ("geom 'arm::rod::shape' is thin", "link 'rod'"),
        ("'arm::what' is odd", "model 'arm'"),
    ],
)
def test_a_warning_names_what_it_is_about(build, words: str, subject: str) -> None:
    engine = build.engine(build.arm())
    mujoco.get_mju_user_warning()(words)
    engine.step()
    (found,) = engine.diagnostics.by_code("engine.mujoco-warning")
    rest = "" if subject.startswith("model") else " of model 'arm'"
    assert found.message == f"MuJoCo warns of {subject}{rest}: {words}"


def test_a_number_of_a_free_body_names_its_link(build) -> None:
    engine = build.engine(build.block())
    mujoco.get_mju_user_warning()("Nan, Inf or huge value in QACC at DOF 3.")
    engine.step()
    (found,) = engine.diagnostics.by_code("engine.mujoco-warning")
    assert found.message.startswith("MuJoCo warns of link ")
    assert " of model 'block': Nan" in found.message


def test_a_warning_without_names_keeps_its_words(build) -> None:
    engine = build.engine(build.block())
    mujoco.get_mju_user_warning()("Too many contacts.\nSimplify 'x'")
    told = Diagnostics()
    report_library_warnings(engine.world, told)
    assert [item.message for item in told] == ["MuJoCo warns: Too many contacts. Simplify 'x'"]
