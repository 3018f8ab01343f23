// Times and lengths of time in nanoseconds.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

namespace tf2 {

using Duration = std::chrono::nanoseconds;
using TimePoint = std::chrono::time_point<std::chrono::system_clock, Duration>;
using IDuration = std::chrono::duration<int, std::nano>;
// "The latest that is known", where a time is asked for.
static const TimePoint TimePointZero = TimePoint(IDuration::zero());

inline TimePoint get_now() {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}
inline Duration durationFromSec(double t_sec) {
  const double whole = std::floor(t_sec);
  return std::chrono::seconds(static_cast<std::int64_t>(whole)) +
         Duration(static_cast<std::int64_t>(std::round((t_sec - whole) * 1e9)));
}
inline TimePoint timeFromSec(double t_sec) { return TimePoint(durationFromSec(t_sec)); }
inline double durationToSec(const Duration& input) {
  const std::int64_t whole = input.count() / 1000000000;
  return static_cast<double>(whole) + 1e-9 * static_cast<double>(input.count() % 1000000000);
}
inline double timeToSec(const TimePoint& timepoint) {
  return durationToSec(timepoint.time_since_epoch());
}
inline std::string displayTimePoint(const TimePoint& stamp) {
  return std::to_string(timeToSec(stamp));
}

}  // namespace tf2
