#pragma once

#include <cmath>
#include <memory>

#include "diagnostic_updater/diagnostic_updater.hpp"

namespace diagnostic_updater {

struct Levels {
  static constexpr unsigned char kOk = 0, kWarn = 1, kError = 2;
};
struct TaskClock {
  TaskClock() : clock(std::make_shared<rclcpp::Clock>()) {}
  TaskClock(rclcpp::Clock::SharedPtr other) : clock(std::move(other)) {}  // NOLINT
  rclcpp::Clock::SharedPtr clock;
};
inline double seconds_now(const TaskClock& from) { return from.clock->now().seconds(); }
inline double seconds_of(const rclcpp::Time& stamp) { return stamp.seconds(); }

#include "gazelle/diagnostics/update_functions.inc"

}  // namespace diagnostic_updater
