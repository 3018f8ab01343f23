"""Files of trees: versions 3 and 4, subtrees, blackboards, and what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.nav2.behavior_trees.script import ScriptError, check_script, evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import Blackboard, Status
from gazelle.nodes.nav2.behavior_trees.xml_parsing import build_tree, parse_trees, read_trees

_SUBTREES = """
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <Script code="a := 1; b := 2"/>
      <SubTree ID="Inner" x="{a}" literal="7" {attributes}/>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Inner"><Script code="{code}"/></BehaviorTree>
</root>
"""


def _problems(xml: str) -> list[str]:
    diagnostics = Diagnostics()
    assert parse_trees(xml, "tree.xml", diagnostics) is None
    return [str(item) for item in diagnostics]


def _tree(nodes: str) -> str:
    return f'<root main_tree_to_execute="T"><BehaviorTree ID="T">\n{nodes}\n</BehaviorTree></root>'


def test_subtree_sees_only_what_is_passed_on(plant) -> None:
    xml = _SUBTREES.replace("{attributes}", "").replace("{code}", "x = x + 10; y := literal")
    tree = plant(xml)
    assert tree.execute() is Status.SUCCESS
    board = tree.ports.blackboard
    assert board.get("a") == 11
    assert not board.has("y")
    hidden = _SUBTREES.replace("{attributes}", "").replace("{code}", "z := b")
    with pytest.raises(ScriptError, match="the key 'b' of the blackboard is not set"):
        plant(hidden).execute()


def test_autoremap_and_the_outermost_tree_are_reached(plant) -> None:
    xml = _SUBTREES.replace("{attributes}", '_autoremap="true"').replace("{code}", "z := b")
    tree = plant(xml)
    tree.execute()
    assert tree.ports.blackboard.get("z") == 2
    tree = plant(_SUBTREES.replace("{attributes}", "").replace("{code}", "@b = 5"))
    tree.execute()
    assert tree.ports.blackboard.get("b") == 5


def test_version_3_subtrees_name_keys_without_braces_or_share_the_blackboard(plant) -> None:
    text = """<root main_tree_to_execute="M">
    <BehaviorTree ID="M"><SubTree ID="S" {}/></BehaviorTree>
    <BehaviorTree ID="S"><SetBlackboard output_key="inner" value="v"/></BehaviorTree></root>"""
    tree = plant(text.replace("{}", 'inner="outer"'))
    tree.execute()
    assert tree.ports.blackboard.get("outer") == "v"
    tree = plant(text.replace("{}", '__shared_blackboard="true"'))
    tree.execute()
    assert tree.ports.blackboard.get("inner") == "v"


def test_includes_are_found_beside_the_file(tmp_path: Path, world) -> None:
    (tmp_path / "inner.xml").write_text(
        '<root><BehaviorTree ID="Inner"><AlwaysSuccess/></BehaviorTree></root>'
    )
    (tmp_path / "main.xml").write_text(
        '<root main_tree_to_execute="M"><include path="inner.xml"/>'
        '<BehaviorTree ID="M"><SubTreePlus ID="Inner"/></BehaviorTree></root>'
    )
    diagnostics = Diagnostics()
    file = read_trees(tmp_path / "main.xml", diagnostics)
    assert file is not None
    assert build_tree(file, Blackboard(), world).execute() is Status.SUCCESS


def test_generic_tags_name_their_kind(plant) -> None:
    xml = '<Control ID="Sequence"><Condition ID="AlwaysSuccess"/></Control>'
    assert plant(xml, version=3).execute() is Status.SUCCESS


def test_all_mistakes_are_told_at_once_with_their_lines() -> None:
    nodes = """<Sequence>
      <FolowPath path="{path}"/>
      <Wait wait_duraton="5"/>
      <Inverter/>
      <SubTree ID="Missing"/>
      <ScriptCondition code="1 +"/>
    </Sequence>"""
    found = _problems(_tree(nodes))
    assert len(found) == 5
    assert "tree.xml:3" in found[0]
    assert "'FolowPath' is no node of BehaviorTree.CPP or Nav2" in found[0]
    assert "FollowPath" in found[0].partition("fix:")[2]
    assert "[navigation.tree-unknown-node]" in found[0]
    assert "<Wait> has no port 'wait_duraton'" in found[1]
    assert "[navigation.tree-unknown-port]" in found[1]
    assert "wait_duration" in found[1].partition("fix:")[2]
    assert "<Inverter> has 0 children; it takes 1" in found[2]
    assert "[navigation.tree-structure]" in found[2]
    assert "names the tree 'Missing', which no file defines" in found[3]
    assert "it ends too early" in found[4]


@pytest.mark.parametrize(
    ("xml", "words"),
    [
        ("<tree/>", "the outermost tag is <tree>, not <root>"),
        ("<root/>", "main_tree_to_execute is missing"),
        ('<root main_tree_to_execute="X"><BehaviorTree ID="Y"><AlwaysSuccess/></BehaviorTree>'
         "</root>", "main_tree_to_execute is 'X', and there is no such <BehaviorTree>"),
        ('<root><BehaviorTree ID="Y"/></root>', "<BehaviorTree ID='Y'> has 0 children"),
        ('<root><BehaviorTree ID="Y"><SubTree ID="Y"/></BehaviorTree></root>',
         "the tree 'Y' has itself as a subtree: Y → Y"),
    ],
)  # fmt: skip
def test_files_that_make_no_tree(xml, words) -> None:
    assert words in "\n".join(_problems(xml))


@pytest.mark.parametrize(
    ("script", "value"),
    [
        ("1 + 2 * 3", 7), ("(1 + 2) * 3", 9), ("-2 + 5", 3), ("7 / 2", 3.5), ("0x10", 16),
        ("1 < 2 && 2 < 1", False), ("1 < 2 || missing", True), ("!true", False),
        ("n == 4 ? 'even' : 'odd'", "even"), ("'a' .. 'b'", "ab"), ("n & 6", 4),
        ("m := n; m *= 2; m", 8), ("n += 1", 5), ("n != 4", False), ("false && n / 0", False),
    ],
)  # fmt: skip
def test_scripts_compute(script, value) -> None:
    board = Blackboard()
    board.set("n", 4.0)
    assert evaluate(script, board) == value


@pytest.mark.parametrize(
    ("script", "words"),
    [
        ("1 +", "it ends too early"), ("(1", "a ')' is missing"), ("a ? 1", "a ':' is missing"),
        ("1 2", "'2' is not expected"), ("$", "'$' is not understood"),
        ("(" * 200 + "1", "nested too deeply"), ("!" * 200 + "1", "nested too deeply"),
        ("1" * 20_000, "too long"),
    ],
)  # fmt: skip
def test_scripts_that_cannot_be_read(script, words) -> None:
    assert words in check_script(script)


def test_scripts_that_cannot_be_run() -> None:
    with pytest.raises(ScriptError, match="the key 'k' does not exist; := would make it"):
        evaluate("k = 1", Blackboard())
    with pytest.raises(ScriptError, match="float division by zero"):
        evaluate("1 / 0", Blackboard())
    with pytest.raises(ScriptError, match=r"'a' - 1\.0"):
        evaluate("'a' - 1", Blackboard())


def test_scripts_of_conditions_run_after_the_node(plant) -> None:
    tree = plant('<AlwaysSuccess _onSuccess="done := 1" _post="n := 2"/>')
    tree.execute()
    assert (tree.ports.blackboard.get("done"), tree.ports.blackboard.get("n")) == (1, 2)
    tree = plant('<Wait wait_duration="1" _while="go" _onHalted="stopped := 1"/>', go=1)
    assert tree.execute() is Status.RUNNING
    tree.ports.blackboard.set("go", 0)
    assert tree.execute() is Status.SKIPPED


def test_private_keys_stay_in_the_subtree() -> None:
    outer = Blackboard()
    inner = Blackboard(outer, takes_all=True)
    inner.set("_private", 1)
    inner.set("public", 2)
    assert not outer.has("_private")
    assert outer.get("public") == 2
