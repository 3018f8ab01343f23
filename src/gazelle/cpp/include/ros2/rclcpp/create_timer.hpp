#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>

#include "rclcpp/detail/interface_of.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {
namespace detail {

template <typename Rep, typename Period>
std::chrono::nanoseconds safe_cast_to_period_in_ns(std::chrono::duration<Rep, Period> period) {
  if (period < std::chrono::duration<Rep, Period>::zero()) {
    throw std::invalid_argument("timer period cannot be negative");
  }
  const auto most = std::chrono::duration<double, std::nano>(std::chrono::nanoseconds::max());
  if (std::chrono::duration<double, std::nano>(period) > most) {
    throw std::invalid_argument("timer period must be less than std::chrono::nanoseconds::max()");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(period);
}

}  // namespace detail

template <typename CallbackT>
typename TimerBase::SharedPtr create_timer(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node,
    std::shared_ptr<node_interfaces::NodeTimersInterface> timers, Clock::SharedPtr clock,
    Duration period, CallbackT&& callback, CallbackGroup::SharedPtr group = nullptr,
    bool autostart = true) {
  if (!clock) throw std::invalid_argument("clock cannot be null");
  if (!node) throw std::invalid_argument("input node_base cannot be null");
  auto made = std::make_shared<GenericTimer<std::decay_t<CallbackT>>>(
      clock, detail::safe_cast_to_period_in_ns(period.to_chrono<std::chrono::nanoseconds>()),
      std::decay_t<CallbackT>(std::forward<CallbackT>(callback)), node->get_context(), autostart);
  timers->add_timer(made, group);
  return made;
}

template <typename NodeT, typename CallbackT,
          std::enable_if_t<
              !std::is_convertible_v<NodeT, std::shared_ptr<node_interfaces::NodeBaseInterface>>,
              int> = 0>
typename TimerBase::SharedPtr create_timer(NodeT node, Clock::SharedPtr clock, Duration period,
                                           CallbackT&& callback,
                                           CallbackGroup::SharedPtr group = nullptr,
                                           bool autostart = true) {
  return create_timer(node_interfaces::get_node_base_interface(node),
                      node_interfaces::get_node_timers_interface(node), std::move(clock), period,
                      std::forward<CallbackT>(callback), std::move(group), autostart);
}

template <typename CallbackT, typename Rep, typename Period>
typename TimerBase::SharedPtr create_timer(Clock::SharedPtr clock,
                                           std::chrono::duration<Rep, Period> period,
                                           CallbackT&& callback, CallbackGroup::SharedPtr group,
                                           node_interfaces::NodeBaseInterface* node,
                                           node_interfaces::NodeTimersInterface* timers,
                                           bool autostart = true) {
  if (!clock) throw std::invalid_argument("clock cannot be null");
  if (!node) throw std::invalid_argument("input node_base cannot be null");
  if (!timers) throw std::invalid_argument("input node_timers cannot be null");
  auto made = std::make_shared<GenericTimer<std::decay_t<CallbackT>>>(
      clock, detail::safe_cast_to_period_in_ns(period),
      std::decay_t<CallbackT>(std::forward<CallbackT>(callback)), node->get_context(), autostart);
  timers->add_timer(made, group);
  return made;
}

template <typename CallbackT, typename Rep, typename Period>
typename TimerBase::SharedPtr create_wall_timer(std::chrono::duration<Rep, Period> period,
                                                CallbackT&& callback,
                                                CallbackGroup::SharedPtr group,
                                                node_interfaces::NodeBaseInterface* node,
                                                node_interfaces::NodeTimersInterface* timers,
                                                bool autostart = true) {
  if (!node) throw std::invalid_argument("input node_base cannot be null");
  if (!timers) throw std::invalid_argument("input node_timers cannot be null");
  auto made = std::make_shared<WallTimer<std::decay_t<CallbackT>>>(
      detail::safe_cast_to_period_in_ns(period),
      std::decay_t<CallbackT>(std::forward<CallbackT>(callback)), node->get_context(), autostart);
  timers->add_timer(made, group);
  return made;
}

}  // namespace rclcpp
