#pragma once

#include "diagnostic_updater/diagnostic_updater.h"

#include <cmath>

namespace diagnostic_updater {

struct Levels {
  static constexpr unsigned char kOk = 0, kWarn = 1, kError = 2;
};
struct TaskClock {
  TaskClock(int = 0) {}  // NOLINT: ROS 1 has one clock
};
inline double seconds_now(const TaskClock&) { return ros::Time::now().toSec(); }
inline double seconds_of(const ros::Time& stamp) { return stamp.toSec(); }

#include "gazelle/diagnostics/update_functions.inc"

}  // namespace diagnostic_updater
