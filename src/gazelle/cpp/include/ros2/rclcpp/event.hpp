#pragma once

#include <atomic>

#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// A flag that is set once and looked at, or taken back.
class Event {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Event)
  Event() = default;
  RCLCPP_DISABLE_COPY(Event)
  bool set() { return state_.exchange(true); }
  bool check() { return state_.load(); }
  bool check_and_clear() { return state_.exchange(false); }

 private:
  std::atomic_bool state_{false};
};

}  // namespace rclcpp
