#pragma once

#include <ros/exception.h>
#include <ros/macros.h>

#include <climits>
#include <cmath>
#include <cstdint>
#include <iosfwd>
#include <stdexcept>
#include <string>

namespace boost {
namespace posix_time {
class time_duration;
}
}  // namespace boost

namespace ros {

/// Brings nanoseconds between 0 and a second; throws std::runtime_error outside of 32 bit seconds.
ROSTIME_DECL void normalizeSecNSecSigned(int64_t& sec, int64_t& nsec);
ROSTIME_DECL void normalizeSecNSecSigned(int32_t& sec, int32_t& nsec);

/// What both kinds of durations share: seconds and nanoseconds, the latter never negative.
template <class T>
class DurationBase {
 public:
  int32_t sec, nsec;

  DurationBase() : sec(0), nsec(0) {}
  DurationBase(int32_t seconds, int32_t nanoseconds) : sec(seconds), nsec(nanoseconds) {
    normalizeSecNSecSigned(sec, nsec);
  }
  explicit DurationBase(double seconds) { fromSec(seconds); }

  T operator+(const T& other) const {
    T sum;
    return sum.fromNSec(toNSec() + other.toNSec());
  }
  T operator-(const T& other) const {
    T difference;
    return difference.fromNSec(toNSec() - other.toNSec());
  }
  T operator-() const {
    T negative;
    return negative.fromNSec(-toNSec());
  }
  T operator*(double scale) const { return T(toSec() * scale); }
  T& operator+=(const T& other) { return self() = *this + other; }
  T& operator-=(const T& other) { return self() = *this - other; }
  T& operator*=(double scale) { return fromSec(toSec() * scale); }

  bool operator==(const T& other) const { return sec == other.sec && nsec == other.nsec; }
  bool operator!=(const T& other) const { return !(*this == other); }
  bool operator<(const T& other) const { return toNSec() < other.toNSec(); }
  bool operator>(const T& other) const { return toNSec() > other.toNSec(); }
  bool operator<=(const T& other) const { return toNSec() <= other.toNSec(); }
  bool operator>=(const T& other) const { return toNSec() >= other.toNSec(); }

  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  int64_t toNSec() const { return static_cast<int64_t>(sec) * 1000000000ll + nsec; }
  T& fromSec(double seconds) {
    const int64_t whole = static_cast<int64_t>(std::floor(seconds));
    if (!(seconds >= static_cast<double>(INT_MIN) && seconds < static_cast<double>(INT_MAX) + 1.0))
      throw std::runtime_error("Duration is out of dual 32-bit range");
    int64_t rest = static_cast<int64_t>(std::round((seconds - static_cast<double>(whole)) * 1e9));
    int64_t carried = whole;
    normalizeSecNSecSigned(carried, rest);
    sec = static_cast<int32_t>(carried);
    nsec = static_cast<int32_t>(rest);
    return self();
  }
  T& fromNSec(int64_t nanoseconds) {
    int64_t whole = nanoseconds / 1000000000ll;
    int64_t rest = nanoseconds % 1000000000ll;
    normalizeSecNSecSigned(whole, rest);
    sec = static_cast<int32_t>(whole);
    nsec = static_cast<int32_t>(rest);
    return self();
  }
  bool isZero() const { return sec == 0 && nsec == 0; }
  boost::posix_time::time_duration toBoost() const;

 private:
  T& self() { return *static_cast<T*>(this); }
};

class Rate;
class WallRate;

/// A span of the time that ros::Time tells, simulated or not.
class ROSTIME_DECL Duration : public DurationBase<Duration> {
 public:
  Duration() {}
  Duration(int32_t seconds, int32_t nanoseconds) : DurationBase<Duration>(seconds, nanoseconds) {}
  explicit Duration(double seconds) { fromSec(seconds); }
  explicit Duration(const Rate& rate);
  /// Sleeps this long of simulated time where there is one; false when it was interrupted.
  bool sleep() const;

  static const Duration MAX;
  static const Duration MIN;
  static const Duration ZERO;
  static const Duration DAY;
  static const Duration HOUR;
  static const Duration MINUTE;
  static const Duration SECOND;
  static const Duration MILLISECOND;
  static const Duration MICROSECOND;
  static const Duration NANOSECOND;
};

extern ROSTIME_DECL const Duration DURATION_MAX;
extern ROSTIME_DECL const Duration DURATION_MIN;

/// A span of the machine's time.
class ROSTIME_DECL WallDuration : public DurationBase<WallDuration> {
 public:
  WallDuration() {}
  WallDuration(int32_t seconds, int32_t nanoseconds)
      : DurationBase<WallDuration>(seconds, nanoseconds) {}
  explicit WallDuration(double seconds) { fromSec(seconds); }
  explicit WallDuration(const Rate& rate);
  bool sleep() const;

  static const WallDuration MAX;
  static const WallDuration MIN;
  static const WallDuration ZERO;
  static const WallDuration DAY;
  static const WallDuration HOUR;
  static const WallDuration MINUTE;
  static const WallDuration SECOND;
  static const WallDuration MILLISECOND;
  static const WallDuration MICROSECOND;
  static const WallDuration NANOSECOND;
};

ROSTIME_DECL std::ostream& operator<<(std::ostream& stream, const Duration& duration);
ROSTIME_DECL std::ostream& operator<<(std::ostream& stream, const WallDuration& duration);

}  // namespace ros
