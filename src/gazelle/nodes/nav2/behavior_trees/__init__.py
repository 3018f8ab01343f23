"""Behaviour trees: BehaviorTree.CPP's XML of versions 3 and 4, its nodes and Nav2's."""
