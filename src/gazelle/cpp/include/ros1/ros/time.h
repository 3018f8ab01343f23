#pragma once

#include <ros/duration.h>
#include <ros/exception.h>
#include <ros/macros.h>
#include <ros/platform.h>

#include <cmath>
#include <cstdint>
#include <iosfwd>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

namespace boost {
namespace posix_time {
class ptime;
}
}  // namespace boost

namespace ros {

/// ros::Time::now() was asked before ros::Time::init() or a NodeHandle.
class ROSTIME_DECL TimeNotInitializedException : public Exception {
 public:
  TimeNotInitializedException()
      : Exception(
            "Cannot use ros::Time::now() before the first NodeHandle has been created or "
            "ros::start() has been called.  If this is a standalone app or test that just uses "
            "ros::Time and does not communicate over ROS, you may also call ros::Time::init()") {}
};

/// Kept for programs that catch it; the clocks of this machine always have a good resolution.
class ROSTIME_DECL NoHighPerformanceTimersException : public Exception {
 public:
  NoHighPerformanceTimersException() : Exception("This system has no precise clock.") {}
};

ROSTIME_DECL void normalizeSecNSec(uint64_t& sec, uint64_t& nsec);
ROSTIME_DECL void normalizeSecNSec(uint32_t& sec, uint32_t& nsec);
ROSTIME_DECL void normalizeSecNSecUnsigned(int64_t& sec, int64_t& nsec);

/// What all kinds of times share: unsigned seconds and nanoseconds.
template <class T, class D>
class TimeBase {
 public:
  uint32_t sec, nsec;

  TimeBase() : sec(0), nsec(0) {}
  TimeBase(uint32_t seconds, uint32_t nanoseconds) : sec(seconds), nsec(nanoseconds) {
    normalizeSecNSec(sec, nsec);
  }
  explicit TimeBase(double seconds) { fromSec(seconds); }

  D operator-(const T& other) const {
    D difference;
    return difference.fromNSec(static_cast<int64_t>(toNSec()) -
                               static_cast<int64_t>(other.toNSec()));
  }
  T operator+(const D& span) const { return moved(span.sec, span.nsec); }
  T operator-(const D& span) const {
    return moved(-static_cast<int64_t>(span.sec), -static_cast<int64_t>(span.nsec));
  }
  T& operator+=(const D& span) { return self() = *this + span; }
  T& operator-=(const D& span) { return self() = *this - span; }

  bool operator==(const T& other) const { return sec == other.sec && nsec == other.nsec; }
  bool operator!=(const T& other) const { return !(*this == other); }
  bool operator<(const T& other) const { return toNSec() < other.toNSec(); }
  bool operator>(const T& other) const { return toNSec() > other.toNSec(); }
  bool operator<=(const T& other) const { return toNSec() <= other.toNSec(); }
  bool operator>=(const T& other) const { return toNSec() >= other.toNSec(); }

  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  uint64_t toNSec() const { return static_cast<uint64_t>(sec) * 1000000000ull + nsec; }
  T& fromSec(double seconds) {
    if (!(seconds >= 0.0)) throw std::runtime_error("Time cannot be negative.");
    if (seconds >= 4294967296.0) throw std::runtime_error("Time is out of dual 32-bit range");
    int64_t whole = static_cast<int64_t>(std::floor(seconds));
    int64_t rest = static_cast<int64_t>(std::round((seconds - static_cast<double>(whole)) * 1e9));
    normalizeSecNSecUnsigned(whole, rest);
    sec = static_cast<uint32_t>(whole);
    nsec = static_cast<uint32_t>(rest);
    return self();
  }
  T& fromNSec(uint64_t nanoseconds) {
    uint64_t whole = 0;
    uint64_t rest = nanoseconds;
    normalizeSecNSec(whole, rest);
    sec = static_cast<uint32_t>(whole);
    nsec = static_cast<uint32_t>(rest);
    return self();
  }
  bool isZero() const { return sec == 0 && nsec == 0; }
  bool is_zero() const { return isZero(); }
  boost::posix_time::ptime toBoost() const;

 private:
  T& self() { return *static_cast<T*>(this); }
  T moved(int64_t seconds, int64_t nanoseconds) const {
    int64_t whole = static_cast<int64_t>(sec) + seconds;
    int64_t rest = static_cast<int64_t>(nsec) + nanoseconds;
    normalizeSecNSecUnsigned(whole, rest);
    return T(static_cast<uint32_t>(whole), static_cast<uint32_t>(rest));
  }
};

/// The time that a graph agrees on: a simulator's, or the machine's.
class ROSTIME_DECL Time : public TimeBase<Time, Duration> {
 public:
  Time() {}
  Time(uint32_t seconds, uint32_t nanoseconds) : TimeBase<Time, Duration>(seconds, nanoseconds) {}
  explicit Time(double seconds) { fromSec(seconds); }

  static Time now();
  static bool sleepUntil(const Time& end);
  static void init();
  static void shutdown();
  static void setNow(const Time& now);
  static bool useSystemTime();
  static bool isSimTime();
  static bool isSystemTime();
  static bool isValid();
  static bool waitForValid();
  static bool waitForValid(const ros::WallDuration& timeout);
  static Time fromBoost(const boost::posix_time::ptime& time);
  static Time fromBoost(const boost::posix_time::time_duration& span);

  static const Time MIN;
  static const Time MAX;
  static const Time ZERO;
  static const Time UNINITIALIZED;
};

extern ROSTIME_DECL const Time TIME_MAX;
extern ROSTIME_DECL const Time TIME_MIN;

/// The machine's time of day.
class ROSTIME_DECL WallTime : public TimeBase<WallTime, WallDuration> {
 public:
  WallTime() {}
  WallTime(uint32_t seconds, uint32_t nanoseconds)
      : TimeBase<WallTime, WallDuration>(seconds, nanoseconds) {}
  explicit WallTime(double seconds) { fromSec(seconds); }

  static WallTime now();
  static bool sleepUntil(const WallTime& end);
  static bool isSystemTime() { return true; }

  static const WallTime MIN;
  static const WallTime MAX;
  static const WallTime ZERO;
  static const WallTime UNINITIALIZED;
};

/// The machine's clock that nobody sets.
class ROSTIME_DECL SteadyTime : public TimeBase<SteadyTime, WallDuration> {
 public:
  SteadyTime() {}
  SteadyTime(uint32_t seconds, uint32_t nanoseconds)
      : TimeBase<SteadyTime, WallDuration>(seconds, nanoseconds) {}
  explicit SteadyTime(double seconds) { fromSec(seconds); }

  static SteadyTime now();
  static bool sleepUntil(const SteadyTime& end);
  static bool isSystemTime() { return true; }

  static const SteadyTime MIN;
  static const SteadyTime MAX;
  static const SteadyTime ZERO;
  static const SteadyTime UNINITIALIZED;
};

ROSTIME_DECL std::ostream& operator<<(std::ostream& stream, const Time& time);
ROSTIME_DECL std::ostream& operator<<(std::ostream& stream, const WallTime& time);
ROSTIME_DECL std::ostream& operator<<(std::ostream& stream, const SteadyTime& time);

}  // namespace ros
