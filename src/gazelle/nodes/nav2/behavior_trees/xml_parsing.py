"""Trees from XML: BehaviorTree.CPP's files of versions 3 and 4, with the place of each mistake."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.xml import Tag, parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.nodes.nav2.behavior_trees.actions import ACTIONS
from gazelle.nodes.nav2.behavior_trees.conditions import CONDITIONS
from gazelle.nodes.nav2.behavior_trees.controls import CONTROLS
from gazelle.nodes.nav2.behavior_trees.decorators import DECORATORS
from gazelle.nodes.nav2.behavior_trees.ros_interface import RosInterface
from gazelle.nodes.nav2.behavior_trees.script import Conditioned, check_script, conditions_of
from gazelle.nodes.nav2.behavior_trees.tree_node import Blackboard, Ports, SubTree, TreeNode

__all__ = ["NODE_TYPES", "TreeFile", "build_tree", "parse_trees", "read_trees"]

NODE_TYPES: Mapping[str, type[TreeNode]] = {**CONTROLS, **DECORATORS, **CONDITIONS, **ACTIONS}
"""Every kind of node that there is, by its name in XML."""

_SUBTREES = ("SubTree", "SubTreePlus")
_GENERIC = ("Action", "Condition", "Control", "Decorator")
_MAX_DEPTH = 100


@dataclass(frozen=True, slots=True)
class TreeFile:
    """What one file says, with what it includes.

    Attributes:
        main: the tree to run.
        trees: root tags by the trees' names.
        version: 3 or 4.
    """

    main: str
    trees: Mapping[str, Tag]
    version: int


def read_trees(path: Path, diagnostics: Diagnostics) -> TreeFile | None:
    """Read a file; None when it has errors, which are all reported."""
    root = read_xml(path, diagnostics)
    return None if root is None else _checked(root, path.parent, diagnostics)


def parse_trees(text: str, name: str, diagnostics: Diagnostics) -> TreeFile | None:
    """Read a text; None when it has errors, which are all reported."""
    root = parse_xml(text, name, diagnostics)
    return None if root is None else _checked(root, None, diagnostics)


def build_tree(file: TreeFile, blackboard: Blackboard, ros: RosInterface) -> TreeNode:
    """Make the nodes of a file's main tree."""
    return _build(file.trees[file.main], file, blackboard, ros)


def _checked(root: Tag, folder: Path | None, diagnostics: Diagnostics) -> TreeFile | None:
    before = len(diagnostics.errors)
    if root.name != "root":
        message = f"the outermost tag is <{root.name}>, not <root>"
        diagnostics.report("navigation.tree-structure", message, root.span)
        return None
    trees: dict[str, Tag] = {}
    _collect(root, folder, trees, diagnostics, 0)
    main = root.attributes.get("main_tree_to_execute", "")
    if not main and len(trees) == 1:
        main = next(iter(trees))
    version = 4 if root.attributes.get("BTCPP_format", "").startswith("4") else 3
    file = TreeFile(main, trees, version)
    if main not in trees:
        text = f"main_tree_to_execute is '{main}', and there is no such <BehaviorTree>"
        text = text if main else "main_tree_to_execute is missing, and there are several trees"
        fix = did_you_mean(main, trees) or f"there are {', '.join(trees) or 'none'}"
        diagnostics.report("navigation.tree-structure", text, root.span, fix=fix)
        return None
    for tag in trees.values():
        _check(tag, file, diagnostics)
    _check_loops(file, diagnostics)
    return None if len(diagnostics.errors) > before else file


def _collect(
    root: Tag, folder: Path | None, trees: dict[str, Tag], diagnostics: Diagnostics, depth: int
) -> None:
    for tag in root.children:
        if tag.name == "include" and folder is not None and depth < _MAX_DEPTH:
            path = folder / tag.attributes.get("path", "")
            included = read_xml(path, diagnostics)
            if included is not None:
                _collect(included, path.parent, trees, diagnostics, depth + 1)
        elif tag.name == "BehaviorTree":
            name = tag.attributes.get("ID", "BehaviorTree")
            if len(tag.children) != 1:
                text = f"<BehaviorTree ID='{name}'> has {len(tag.children)} children; it needs one"
                diagnostics.report("navigation.tree-structure", text, tag.span)
            else:
                trees[name] = tag.children[0]
        elif tag.name not in ("TreeNodesModel", "include"):
            text = f"<{tag.name}> is neither <BehaviorTree> nor <include>; it is left out"
            diagnostics.report("navigation.tree-structure", text, tag.span)


def _check(tag: Tag, file: TreeFile, diagnostics: Diagnostics) -> None:
    for one in tag.walk():
        kind = _kind(one)
        if one.name in _SUBTREES:
            _check_subtree(one, file, diagnostics)
            continue
        made = NODE_TYPES.get(kind)
        if made is None:
            text = f"'{kind}' is no node of BehaviorTree.CPP or Nav2 that Gazelle knows"
            diagnostics.report(
                "navigation.tree-unknown-node", text, one.span, fix=did_you_mean(kind, NODE_TYPES)
            )
            continue
        _check_children(one, kind, made, diagnostics)
        _check_ports(one, kind, made, diagnostics)


def _check_subtree(tag: Tag, file: TreeFile, diagnostics: Diagnostics) -> None:
    name = tag.attributes.get("ID", "")
    if name not in file.trees:
        text = f"<{tag.name}> names the tree '{name}', which no file defines"
        fix = did_you_mean(name, file.trees)
        diagnostics.report("navigation.tree-structure", text, tag.span, fix=fix)


def _check_children(tag: Tag, kind: str, made: type[TreeNode], diagnostics: Diagnostics) -> None:
    least, most = made.CHILDREN
    count = len(tag.children)
    if count < least or (most is not None and count > most):
        wanted = f"{least}" if most == least else f"{least} or more"
        wanted = wanted if most is None or most == least else f"{least} to {most}"
        text = f"<{kind}> has {count} children; it takes {wanted}"
        diagnostics.report("navigation.tree-structure", text, tag.span)


def _check_ports(tag: Tag, kind: str, made: type[TreeNode], diagnostics: Diagnostics) -> None:
    known = (*made.INPUTS, *made.OUTPUTS)
    for name, value in tag.attributes.items():
        if name in ("name", "ID", "uid") or (name in known and name != "code"):
            continue
        if name.startswith("_") or name == "code":
            problem = check_script(value) if name != "_description" else ""
            if problem:
                diagnostics.report("navigation.tree-structure", problem, tag.span)
            continue
        text = f"<{kind}> has no port '{name}'; it has {', '.join(known) or 'none'}"
        fix = did_you_mean(name, known)
        diagnostics.report("navigation.tree-unknown-port", text, tag.span, fix=fix)


def _check_loops(file: TreeFile, diagnostics: Diagnostics) -> None:
    def visit(name: str, above: tuple[str, ...]) -> None:
        if name in above:
            text = f"the tree '{name}' has itself as a subtree: {' → '.join((*above, name))}"
            diagnostics.report("navigation.tree-structure", text, file.trees[name].span)
            return
        for tag in file.trees[name].walk():
            below = tag.attributes.get("ID", "")
            if tag.name in _SUBTREES and below in file.trees and len(above) < _MAX_DEPTH:
                visit(below, (*above, name))

    visit(file.main, ())


def _kind(tag: Tag) -> str:
    return tag.attributes.get("ID", tag.name) if tag.name in _GENERIC else tag.name


def _build(tag: Tag, file: TreeFile, blackboard: Blackboard, ros: RosInterface) -> TreeNode:
    kind = _kind(tag)
    name = tag.attributes.get("name", tag.attributes.get("ID", kind))
    ports = Ports(name, tag.attributes, blackboard)
    made: TreeNode
    if tag.name in _SUBTREES:
        inner = _inner_blackboard(tag, file, blackboard)
        below = _build(file.trees[tag.attributes["ID"]], file, inner, ros)
        made = SubTree(name, ports, (below,), ros)
    else:
        children = [_build(child, file, blackboard, ros) for child in tag.children]
        made = NODE_TYPES[kind](name, ports, children, ros)
    conditions = conditions_of(tag.attributes)
    if file.version == 4 and conditions:
        made = Conditioned(name, ports, (made,), ros)
        made.conditions = conditions
    return made


def _inner_blackboard(tag: Tag, file: TreeFile, blackboard: Blackboard) -> Blackboard:
    """Return the blackboard of a subtree: shared, or with some keys passed on."""
    attributes = dict(tag.attributes)
    if attributes.get("__shared_blackboard", "").lower() in ("true", "1"):
        return blackboard
    every = attributes.get("__autoremap", attributes.get("_autoremap", "")).lower()
    passed: dict[str, str] = {}
    values: dict[str, str] = {}
    # In version 3 a plain SubTree writes keys without braces.
    bare = file.version == 3 and tag.name == "SubTree"
    for name, text in attributes.items():
        if name in ("ID", "name", "uid") or name.startswith("_"):
            continue
        if text.startswith("{") and text.endswith("}"):
            passed[name] = name if text == "{=}" else text[1:-1]
        elif bare:
            passed[name] = text
        else:
            values[name] = text
    inner = Blackboard(blackboard, passed, takes_all=every in ("true", "1"))
    for name, text in values.items():
        inner.set(name, text)
    return inner
