"""Codes of the graph: topics, services, parameters, tf."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "graph.port-taken",
        "error",
        "Who listens as the graph's hub does not answer",
        "Every process finds the others through the hub: it is stopped, or another program is at"
        " its place, so no graph can start there.",
        "let it go on or end that program, or export GAZELLE_PORT (or ROS_DOMAIN_ID) in all shells",
        "Unable to start XML-RPC server, port 11311 is already in use",
    ),
    Entry(
        "graph.wall-stamps",
        "warning",
        "A node stamps its messages with wall time in a graph with simulated time",
        "Whoever reads them looks for transforms of that time, which never come.",
        "stamp with the node's clock (rospy.Time.now(), node.get_clock().now()), not time.time(); "
        "start the node after use_sim_time is true; ROS 2: --ros-args -p use_sim_time:=true",
        "Lookup would require extrapolation into the future",
    ),
    Entry(
        "graph.type-mismatch",
        "error",
        "Two ends of a topic or service have different types",
        "The messages mean different things, so they are dropped; other ends go on.",
        "use one type, or another topic name",
        "Client wants topic to have datatype/md5sum, but our version has another",
    ),
    Entry(
        "graph.tf-two-authorities",
        "warning",
        "Two nodes publish the same frame",
        "The frame jumps between what the two say; ROS keeps silent and takes both.",
        "end one of the two, or switch its tf off (publish_tf, publishTf, publish_odom_tf)",
        "TF_REPEATED_DATA ignoring data with redundant timestamp",
    ),
)
