from __future__ import annotations

LINKS = "".join(f'<link name="{name}"/>' for name in ("base", "arm", "hand"))


def _joint(name: str, parent: str, child: str) -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="fixed">{ends}</joint>'


def _robot(*joints: str) -> str:
    return f'<robot name="r">{LINKS}{"".join(joints)}</robot>'


def test_missing_links_are_named_with_their_joint_and_the_nearest(read) -> None:
    found = read(_robot(_joint("j", "bse", "arm"), _joint("k", "arm", "finger")))
    assert "parent link 'bse' of joint 'j' not found" in found.message("urdf.parent-missing")
    assert "did you mean 'base'" in found.message("urdf.parent-missing")
    assert 'add <link name="finger"/>' in found.message("urdf.child-missing")
    assert found.model is None


def test_two_roots_name_the_loose_link_and_the_remedy(read) -> None:
    found = read(_robot(_joint("j", "base", "arm")))
    assert found.codes == ["urdf.two-roots"]
    message = found.message("urdf.two-roots")
    assert "two root links found: 'base' and 'hand'" in message
    assert "join 'hand' to the robot with a joint" in message


def test_a_loop_beside_a_good_root_is_found(read) -> None:
    found = read(_robot(_joint("j", "arm", "hand"), _joint("k", "hand", "arm")))
    assert found.codes == ["urdf.loop"]
    assert "not all links hang on 'base'" in found.message("urdf.loop")
    assert "'arm', 'hand'" in found.message("urdf.loop")


def test_a_joint_from_a_link_to_itself_is_a_loop(read) -> None:
    found = read(f'<robot name="r"><link name="a"/>{_joint("j", "a", "a")}</robot>')
    assert found.codes == ["urdf.loop"]


def test_two_parents_name_both_joints(read) -> None:
    found = read(
        _robot(_joint("j", "base", "arm"), _joint("k", "base", "hand"), _joint("l", "hand", "arm"))
    )
    assert "urdf.two-parents" in found.codes
    assert "the child of joint 'j' and of joint 'l'" in found.message("urdf.two-parents")
    assert "'l' counts, the last by name, and 'j' is left out" in found.message("urdf.two-parents")
    assert [joint.name for joint in found.robot.joints] == ["k", "l"]
