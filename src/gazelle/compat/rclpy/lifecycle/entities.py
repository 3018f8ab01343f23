"""What follows the state of its node, and the publisher that is silent until it is active."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from gazelle.compat.rclpy.lifecycle.states import LifecycleState, TransitionCallbackReturn
from gazelle.compat.rclpy.publisher_subscription_service import Publisher

__all__ = ["LifecyclePublisher", "ManagedEntity", "SimpleManagedEntity"]

_SUCCESS = TransitionCallbackReturn.SUCCESS


class ManagedEntity:
    """Hears of its node's transitions; each answer is success here."""

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that the node is configured, coming from `state`."""
        del state
        return _SUCCESS

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that the node is cleaned up."""
        del state
        return _SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that the node ends."""
        del state
        return _SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that the node becomes active."""
        del state
        return _SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that the node becomes inactive."""
        del state
        return _SUCCESS

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hear that a transition went wrong."""
        del state
        return _SUCCESS


class SimpleManagedEntity(ManagedEntity):
    """Knows whether its node is active."""

    def __init__(self) -> None:
        self._enabled = False

    @property
    def is_activated(self) -> bool:
        """True while the node is active."""
        return self._enabled

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to act."""
        del state
        self._enabled = True
        return _SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop to act."""
        del state
        self._enabled = False
        return _SUCCESS

    @staticmethod
    def when_enabled(
        wrapped: Callable[..., Any] | None = None,
        *,
        when_not_enabled: Callable[[], Any] | None = None,
    ) -> Any:
        """Decorate a method that does something only while its entity is active."""

        def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
            @functools.wraps(function)
            def call(self: SimpleManagedEntity, *args: Any, **kwargs: Any) -> Any:
                if self.is_activated:
                    return function(self, *args, **kwargs)
                return None if when_not_enabled is None else when_not_enabled()

            return call

        return decorate if wrapped is None else decorate(wrapped)


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Sends messages while its node is active, and drops them otherwise."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    @SimpleManagedEntity.when_enabled
    def publish(self, msg: Any) -> None:
        """Send a message if the node is active."""
        Publisher.publish(self, msg)
