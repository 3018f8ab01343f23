from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.sdf_reader.frame_graph import FrameGraph, FramePoint
from gazelle.diagnostics import Severity, SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose

SPAN = SourceSpan("test.sdf", 1, 1)


def _point(name, relative_to="", pose=IDENTITY_POSE, attached_to=None):
    return FramePoint(
        "frame", name, relative_to, pose, name if attached_to is None else attached_to, SPAN
    )


def _random_pose(rng):
    return Pose.from_xyz_rpy(tuple(rng.uniform(-2, 2, 3)), tuple(rng.uniform(-3, 3, 3)))


def _close(a, b):
    return np.allclose(a.matrix(), b.matrix(), atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_poses_of_a_random_tree_round_trip(context, diagnostics, seed):
    """Law: writing every true pose relative to a random other frame changes nothing."""
    rng = np.random.default_rng(seed)
    truth = {f"f{number}": _random_pose(rng) for number in range(12)}
    names = list(truth)
    points = {}
    for number, name in enumerate(names):
        parent = "" if number == 0 else rng.choice(["", *names[:number]])
        base = truth[parent] if parent else IDENTITY_POSE
        points[name] = _point(name, str(parent), base.inverse() @ truth[name])
    shuffled = {name: points[name] for name in rng.permutation(names)}
    graph = FrameGraph(shuffled, context, scope="model 'm'")
    assert all(_close(graph.pose(name), truth[name]) for name in names)
    assert not len(diagnostics)


def test_long_chains_are_no_problem(context):
    step = Pose.from_xyz_rpy((0.001, 0, 0))
    points = {"f0": _point("f0", "", step)}
    points |= {f"f{n}": _point(f"f{n}", f"f{n - 1}", step) for n in range(1, 5000)}
    graph = FrameGraph(points, context, scope="model 'm'")
    assert graph.pose("f4999").position_m[0] == pytest.approx(5.0)


def test_circle_is_reported_with_its_names(context, diagnostics):
    points = {"a": _point("a", "b"), "b": _point("b", "c"), "c": _point("c", "a")}
    FrameGraph(points, context, scope="model 'm'").pose("a")
    (found,) = diagnostics.by_code("sdf.frame-cycle")
    assert "a → b → c → a" in found.message
    assert "cycle" in found.phrase


def test_unknown_frame_names_the_nearest(context, diagnostics):
    points = {"base_link": _point("base_link"), "arm": _point("arm", "base_lnk")}
    assert FrameGraph(points, context, scope="model 'm'").pose("arm") == IDENTITY_POSE
    (found,) = diagnostics.by_code("sdf.unknown-frame")
    assert "relative_to='base_lnk' of frame 'arm'" in found.message
    assert "did you mean 'base_link'?" in found.fix


def test_attached_link_follows_frames(context):
    points = {
        "link": _point("link"),
        "one": _point("one", attached_to="two"),
        "two": _point("two", attached_to="link"),
    }
    assert FrameGraph(points, context, scope="model 'm'").attached_link("one") == "link"


def test_attachment_circle_is_reported(context, diagnostics):
    points = {"one": _point("one", attached_to="two"), "two": _point("two", attached_to="one")}
    graph = FrameGraph(points, context, scope="model 'm'", default_attached="base")
    assert graph.attached_link("one") == "base"
    assert "attached_to goes in a circle" in diagnostics.by_code("sdf.frame-cycle")[0].message


def test_frame_without_attachment_moves_with_the_canonical_link(model):
    found = model(
        "<link name='a'/><link name='b'/><frame name='f'><pose>0 0 1 0 0 0</pose></frame>"
    )
    assert [(item.name, item.attached_to) for item in found.frames] == [("f", "a")]


def test_frame_pose_counts_from_what_it_is_attached_to(model):
    found = model(
        "<link name='a'/><link name='b'><pose>0 0 1 0 0 0</pose></link>"
        "<frame name='f' attached_to='b'><pose>0 0 0.5 0 0 0</pose></frame>"
    )
    assert found.frames[0].T_model_frame.position_m == pytest.approx((0, 0, 1.5))


def test_link_pose_relative_to_another_link(model):
    found = model(
        "<link name='a'><pose>1 0 0 0 0 1.5707963267948966</pose></link>"
        "<link name='b'><pose relative_to='a'>1 0 0 0 0 0</pose></link>"
    )
    assert found.link("b").T_model_link.position_m == pytest.approx((1, 1, 0))
    assert found.link("b").T_model_link.rpy_rad == pytest.approx((0, 0, math.pi / 2))


def test_visual_pose_relative_to_another_link_is_given_in_its_own(model):
    found = model(
        "<link name='a'><pose>1 0 0 0 0 0</pose></link><link name='b'><pose>0 2 0 0 0 0</pose>"
        "<visual name='v'><pose relative_to='a'>0 0 3 0 0 0</pose><geometry><box/></geometry>"
        "</visual></link>"
    )
    assert found.link("b").visuals[0].T_link_visual.position_m == pytest.approx((1, -2, 3))


def test_nested_link_name_and_pose(model):
    found = model(
        "<link name='base'/><model name='arm'><pose>0 0 1 0 0 0</pose>"
        "<link name='tip'><pose>0 0 0.5 0 0 0</pose></link></model>"
        "<frame name='f' attached_to='arm::tip'/>"
    )
    assert found.link("arm::tip").T_model_link.position_m == pytest.approx((0, 0, 1.5))
    assert found.frames[0].attached_to == "arm::tip"
    assert found.frames[0].T_model_frame.position_m == pytest.approx((0, 0, 1.5))


def test_placement_frame_puts_that_frame_at_the_pose(model):
    found = model(
        "<link name='base'/><model name='arm' placement_frame='flange'>"
        "<pose>5 0 0 0 0 0</pose><link name='l'/>"
        "<frame name='flange'><pose>1 0 0 0 0 0</pose></frame></model>"
    )
    assert found.link("arm::l").T_model_link.position_m == pytest.approx((4, 0, 0))


def test_unknown_frame_of_the_times_when_gazebo_ignored_it_is_a_warning(model, diagnostics):
    body = "<link name='a'><pose frame='nowhere'>0 0 1 0 0 0</pose></link>"
    assert model(body, version="1.6").link("a").T_model_link.position_m == (0, 0, 1)
    assert not diagnostics.errors
    model(body, version="1.7")
    assert diagnostics.errors[0].code == "sdf.unknown-frame"


@pytest.mark.parametrize("seed", range(5))
def test_model_written_with_other_frames_is_the_same_model(model, seed):
    """Law: relative_to changes how a pose is written, not where the link is."""
    rng = np.random.default_rng(seed)
    truth = {f"l{number}": _random_pose(rng) for number in range(6)}

    def text(name, base, relative_to):
        pose = base.inverse() @ truth[name]
        numbers = " ".join(repr(float(value)) for value in (*pose.position_m, *pose.quat_xyzw))
        attribute = f"relative_to='{relative_to}'" if relative_to else ""
        return (
            f"<link name='{name}'><pose rotation_format='quat_xyzw' {attribute}>{numbers}</pose>"
            "</link>"
        )

    plain = model("".join(text(name, IDENTITY_POSE, "") for name in truth))
    names = list(truth)
    bases = {name: names[int(rng.integers(n))] if n else "" for n, name in enumerate(names)}
    lines = [text(n, truth[bases[n]] if bases[n] else IDENTITY_POSE, bases[n]) for n in names]
    rng.shuffle(lines)
    turned = model("".join(lines))
    assert all(
        _close(turned.link(name).T_model_link, plain.link(name).T_model_link) for name in names
    )


def test_unknown_placement_frame_of_a_model_is_reported(model, diagnostics):
    model("<link name='flange'/>", attributes="placement_frame='flang'")
    (found,) = diagnostics.by_code("sdf.unknown-frame")
    assert "placement_frame 'flang' is no frame of model 'm'" in found.message
    assert found.fix == "did you mean 'flange'?"


def test_unknown_frame_of_a_links_child_is_a_warning(model, diagnostics):
    body = (
        "<link name='l'><sensor name='s' type='imu'>"
        "<pose relative_to='m'>1 0 0 0 0 0</pose></sensor></link>"
    )
    (sensor,) = model(body).link("l").sensors
    assert sensor.T_link_sensor.position_m == (1, 0, 0)
    (finding,) = diagnostics.by_code("sdf.unknown-frame")
    assert finding.severity is Severity.WARNING
    assert "relative_to='m' of sensor 's'" in finding.message
