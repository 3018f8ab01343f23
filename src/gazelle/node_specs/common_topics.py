"""Topics and services that many nodes have."""

from __future__ import annotations

from gazelle.node_specs.spec import listens, offers, publishes

__all__ = ["LIFECYCLE_SERVICES", "LIFECYCLE_TOPICS", "TF_LISTENED"]

TF_LISTENED = (
    listens("/tf", "tf2_msgs/msg/TFMessage"),
    listens("/tf_static", "tf2_msgs/msg/TFMessage"),
)
LIFECYCLE_TOPICS = (publishes("~transition_event", "lifecycle_msgs/msg/TransitionEvent"),)
LIFECYCLE_SERVICES = (
    offers("~change_state", "lifecycle_msgs/srv/ChangeState"),
    offers("~get_available_states", "lifecycle_msgs/srv/GetAvailableStates"),
    offers("~get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions"),
    offers("~get_state", "lifecycle_msgs/srv/GetState"),
    offers("~get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions"),
)
