#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <string>

#include "rclcpp/node.hpp"
#include "rclcpp/wait_set.hpp"

namespace rclcpp {

/// Wait for the next message of a subscription; false where time is up or the context ends.
template <class MsgT, class Rep = int64_t, class Period = std::milli>
bool wait_for_message(
    MsgT& out, std::shared_ptr<Subscription<MsgT>> subscription, std::shared_ptr<Context> context,
    std::chrono::duration<Rep, Period> time_to_wait = std::chrono::duration<Rep, Period>(-1)) {
  auto ended = std::make_shared<GuardCondition>(context);
  auto handle = context->add_on_shutdown_callback([weak = GuardCondition::WeakPtr(ended)]() {
    if (auto strong = weak.lock()) strong->trigger();
  });
  WaitSet wait_set;
  wait_set.add_subscription(subscription);
  wait_set.add_guard_condition(ended);
  const auto result = wait_set.wait(time_to_wait);
  context->remove_on_shutdown_callback(handle);
  if (result.kind() != WaitResultKind::Ready) return false;
  if (ended->do_work()) return false;
  MessageInfo info;
  return subscription->take(out, info);
}

template <class MsgT, class Rep = int64_t, class Period = std::milli>
bool wait_for_message(
    MsgT& out, Node::SharedPtr node, const std::string& topic,
    std::chrono::duration<Rep, Period> time_to_wait = std::chrono::duration<Rep, Period>(-1),
    const QoS& qos = SystemDefaultsQoS()) {
  auto subscription =
      node->create_subscription<MsgT>(topic, qos, [](const std::shared_ptr<const MsgT>) {});
  return wait_for_message<MsgT, Rep, Period>(
      out, subscription, node->get_node_base_interface()->get_context(), time_to_wait);
}

}  // namespace rclcpp
