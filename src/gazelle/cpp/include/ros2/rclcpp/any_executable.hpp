#pragma once

#include <memory>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/executable.hpp"

namespace rclcpp {

namespace node_interfaces {
class NodeBaseInterface;
}

/// One piece of work that is ready, with its group taken until it goes.
struct RCLCPP_PUBLIC AnyExecutable {
  AnyExecutable() = default;
  ~AnyExecutable();
  std::shared_ptr<detail::Executable> work;
  std::shared_ptr<SubscriptionBase> subscription;
  std::shared_ptr<TimerBase> timer;
  std::shared_ptr<ServiceBase> service;
  std::shared_ptr<ClientBase> client;
  std::shared_ptr<Waitable> waitable;
  std::shared_ptr<CallbackGroup> callback_group;
  std::shared_ptr<node_interfaces::NodeBaseInterface> node_base;
  std::shared_ptr<void> data;
};

}  // namespace rclcpp
