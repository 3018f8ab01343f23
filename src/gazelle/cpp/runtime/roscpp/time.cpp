// Times, spans and rates.

#include <ros/rate.h>
#include <ros/time.h>
#include <gazelle/core.hpp>

#include <time.h>

#include <atomic>
#include <cinttypes>
#include <cstdio>
#include <limits>
#include <ostream>

namespace ros {

namespace {

constexpr int64_t kSecond = 1000000000ll;

std::atomic<bool> is_initialized{false};
// What Time::setNow() fixed; negative: what the graph's clock says.
std::atomic<int64_t> fixed_ns{-1};

int64_t clockNow() {
  const int64_t fixed = fixed_ns.load();
  return fixed >= 0 ? fixed : gazelle::clock::now_ns();
}

// A signal ends it early, as in ROS 1: the loop around it then asks ros::ok().
bool sleepWall(int64_t nanoseconds) {
  if (nanoseconds <= 0) return true;
  timespec span{static_cast<time_t>(nanoseconds / kSecond),
                static_cast<long>(nanoseconds % kSecond)};
  return nanosleep(&span, nullptr) == 0;
}

bool sleepUntilClock(int64_t target_ns) {
  if (fixed_ns.load() < 0 && !gazelle::clock::uses_sim_time()) {
    sleepWall(target_ns - gazelle::clock::wall_ns());
    return true;
  }
  while (fixed_ns.load() >= 0 && gazelle::ok()) {
    if (clockNow() >= target_ns) return true;
    sleepWall(kSecond / 1000);
  }
  return gazelle::clock::wait_until(target_ns) == gazelle::clock::Wake::kReached;
}

std::ostream& writeSigned(std::ostream& stream, int32_t sec, int32_t nsec) {
  char text[32];
  if (sec >= 0 || nsec == 0) {
    std::snprintf(text, sizeof text, "%" PRId32 ".%09" PRId32, sec, nsec);
  } else {
    std::snprintf(text, sizeof text, "%s%" PRId32 ".%09" PRId32, sec == -1 ? "-" : "", sec + 1,
                  static_cast<int32_t>(kSecond) - nsec);
  }
  return stream << text;
}

std::ostream& writeUnsigned(std::ostream& stream, uint32_t sec, uint32_t nsec) {
  char text[32];
  std::snprintf(text, sizeof text, "%" PRIu32 ".%09" PRIu32, sec, nsec);
  return stream << text;
}

}  // namespace

void normalizeSecNSecSigned(int64_t& sec, int64_t& nsec) {
  int64_t carried = sec + nsec / kSecond;
  int64_t rest = nsec % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --carried;
  }
  if (carried < std::numeric_limits<int32_t>::min() ||
      carried > std::numeric_limits<int32_t>::max())
    throw std::runtime_error("Duration is out of dual 32-bit range");
  sec = carried;
  nsec = rest;
}

void normalizeSecNSecSigned(int32_t& sec, int32_t& nsec) {
  int64_t wide_sec = sec;
  int64_t wide_nsec = nsec;
  normalizeSecNSecSigned(wide_sec, wide_nsec);
  sec = static_cast<int32_t>(wide_sec);
  nsec = static_cast<int32_t>(wide_nsec);
}

void normalizeSecNSec(uint64_t& sec, uint64_t& nsec) {
  const uint64_t carried = sec + nsec / static_cast<uint64_t>(kSecond);
  if (carried > std::numeric_limits<uint32_t>::max())
    throw std::runtime_error("Time is out of dual 32-bit range");
  nsec %= static_cast<uint64_t>(kSecond);
  sec = carried;
}

void normalizeSecNSec(uint32_t& sec, uint32_t& nsec) {
  uint64_t wide_sec = sec;
  uint64_t wide_nsec = nsec;
  normalizeSecNSec(wide_sec, wide_nsec);
  sec = static_cast<uint32_t>(wide_sec);
  nsec = static_cast<uint32_t>(wide_nsec);
}

void normalizeSecNSecUnsigned(int64_t& sec, int64_t& nsec) {
  int64_t carried = sec + nsec / kSecond;
  int64_t rest = nsec % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --carried;
  }
  if (carried < 0 || carried > std::numeric_limits<uint32_t>::max())
    throw std::runtime_error("Time is out of dual 32-bit range");
  sec = carried;
  nsec = rest;
}

// ---- Constants

const Duration DURATION_MAX(std::numeric_limits<int32_t>::max(), 999999999);
const Duration DURATION_MIN(std::numeric_limits<int32_t>::min(), 0);
const Duration Duration::MAX(std::numeric_limits<int32_t>::max(), 999999999);
const Duration Duration::MIN(std::numeric_limits<int32_t>::min(), 0);
const Duration Duration::ZERO(0, 0);
const Duration Duration::DAY(86400, 0);
const Duration Duration::HOUR(3600, 0);
const Duration Duration::MINUTE(60, 0);
const Duration Duration::SECOND(1, 0);
const Duration Duration::MILLISECOND(0, 1000000);
const Duration Duration::MICROSECOND(0, 1000);
const Duration Duration::NANOSECOND(0, 1);
const WallDuration WallDuration::MAX(std::numeric_limits<int32_t>::max(), 999999999);
const WallDuration WallDuration::MIN(std::numeric_limits<int32_t>::min(), 0);
const WallDuration WallDuration::ZERO(0, 0);
const WallDuration WallDuration::DAY(86400, 0);
const WallDuration WallDuration::HOUR(3600, 0);
const WallDuration WallDuration::MINUTE(60, 0);
const WallDuration WallDuration::SECOND(1, 0);
const WallDuration WallDuration::MILLISECOND(0, 1000000);
const WallDuration WallDuration::MICROSECOND(0, 1000);
const WallDuration WallDuration::NANOSECOND(0, 1);
const Time TIME_MAX(std::numeric_limits<uint32_t>::max(), 999999999);
const Time TIME_MIN(0, 1);
const Time Time::MIN(0, 1);
const Time Time::MAX(std::numeric_limits<uint32_t>::max(), 999999999);
const Time Time::ZERO(0, 0);
const Time Time::UNINITIALIZED(0, 0);
const WallTime WallTime::MIN(0, 1);
const WallTime WallTime::MAX(std::numeric_limits<uint32_t>::max(), 999999999);
const WallTime WallTime::ZERO(0, 0);
const WallTime WallTime::UNINITIALIZED(0, 0);
const SteadyTime SteadyTime::MIN(0, 1);
const SteadyTime SteadyTime::MAX(std::numeric_limits<uint32_t>::max(), 999999999);
const SteadyTime SteadyTime::ZERO(0, 0);
const SteadyTime SteadyTime::UNINITIALIZED(0, 0);

// ---- Time

void Time::init() { is_initialized = true; }
void Time::shutdown() { gazelle::clock::notify_waiters(); }
void Time::setNow(const Time& now) {
  fixed_ns = static_cast<int64_t>(now.toNSec());
  is_initialized = true;
  gazelle::clock::notify_waiters();
}
bool Time::useSystemTime() { return isSystemTime(); }
bool Time::isSimTime() { return fixed_ns.load() >= 0 || gazelle::clock::uses_sim_time(); }
bool Time::isSystemTime() { return !isSimTime(); }

Time Time::now() {
  if (!is_initialized.load(std::memory_order_relaxed)) throw TimeNotInitializedException();
  Time now;
  return now.fromNSec(static_cast<uint64_t>(clockNow()));
}

bool Time::isValid() {
  return is_initialized &&
         (fixed_ns.load() > 0 || (fixed_ns.load() < 0 && gazelle::clock::is_valid()));
}
bool Time::waitForValid() { return waitForValid(WallDuration()); }
bool Time::waitForValid(const WallDuration& timeout) {
  const int64_t end = gazelle::clock::steady_ns() + timeout.toNSec();
  while (!isValid()) {
    if (!gazelle::ok() || (!timeout.isZero() && gazelle::clock::steady_ns() > end)) return false;
    sleepWall(10 * kSecond / 1000);
  }
  return gazelle::ok();
}

bool Time::sleepUntil(const Time& end) {
  const Duration left = end - now();
  return left.sec < 0 || left.isZero() || sleepUntilClock(static_cast<int64_t>(end.toNSec()));
}

bool Duration::sleep() const {
  const int64_t span = toNSec();
  if (span <= 0) return !Time::isSimTime() || gazelle::ok();
  if (fixed_ns.load() < 0 && !gazelle::clock::uses_sim_time()) {
    sleepWall(span);
    return true;
  }
  // Simulated time that has not begun is waited for first.
  if (clockNow() == 0 && gazelle::clock::wait_until(1) == gazelle::clock::Wake::kStopped)
    return false;
  return sleepUntilClock(clockNow() + span);
}

WallTime WallTime::now() {
  WallTime now;
  return now.fromNSec(static_cast<uint64_t>(gazelle::clock::wall_ns()));
}
bool WallTime::sleepUntil(const WallTime& end) {
  const WallDuration left = end - now();
  return left.toNSec() <= 0 || left.sleep();
}
bool WallDuration::sleep() const {
  sleepWall(toNSec());
  return true;
}
SteadyTime SteadyTime::now() {
  SteadyTime now;
  return now.fromNSec(static_cast<uint64_t>(gazelle::clock::steady_ns()));
}
bool SteadyTime::sleepUntil(const SteadyTime& end) {
  const WallDuration left = end - now();
  return left.toNSec() <= 0 || left.sleep();
}

std::ostream& operator<<(std::ostream& stream, const Duration& duration) {
  return writeSigned(stream, duration.sec, duration.nsec);
}
std::ostream& operator<<(std::ostream& stream, const WallDuration& duration) {
  return writeSigned(stream, duration.sec, duration.nsec);
}
std::ostream& operator<<(std::ostream& stream, const Time& time) {
  return writeUnsigned(stream, time.sec, time.nsec);
}
std::ostream& operator<<(std::ostream& stream, const WallTime& time) {
  return writeUnsigned(stream, time.sec, time.nsec);
}
std::ostream& operator<<(std::ostream& stream, const SteadyTime& time) {
  return writeUnsigned(stream, time.sec, time.nsec);
}

// ---- Rates

Duration::Duration(const Rate& rate) : DurationBase<Duration>() {
  *this = rate.expectedCycleTime();
}
WallDuration::WallDuration(const Rate& rate) : DurationBase<WallDuration>() {
  fromNSec(rate.expectedCycleTime().toNSec());
}

namespace {

// One cycle: sleep what is left of it; start anew after a jump or where more than one was missed.
template <class T, class D>
bool sleepCycle(T& start, const D& expected, D& actual) {
  T expected_end = start + expected;
  const T actual_end = T::now();
  if (actual_end < start) expected_end = actual_end + expected;  // time went back
  const D left = expected_end - actual_end;
  actual = actual_end - start;
  start = expected_end;
  if (left <= D(0.0)) {
    if (actual_end > expected_end + expected) start = actual_end;
    return left.isZero();
  }
  return left.sleep();
}

}  // namespace

Rate::Rate(double frequency)
    : start_(Time::now()), expected_cycle_time_(1.0 / frequency), actual_cycle_time_(0.0) {}
Rate::Rate(const Duration& cycle)
    : start_(Time::now()), expected_cycle_time_(cycle), actual_cycle_time_(0.0) {}
bool Rate::sleep() { return sleepCycle(start_, expected_cycle_time_, actual_cycle_time_); }
void Rate::reset() { start_ = Time::now(); }

WallRate::WallRate(double frequency)
    : start_(WallTime::now()), expected_cycle_time_(1.0 / frequency), actual_cycle_time_(0.0) {}
WallRate::WallRate(const Duration& cycle)
    : start_(WallTime::now()),
      expected_cycle_time_(cycle.sec, cycle.nsec),
      actual_cycle_time_(0.0) {}
bool WallRate::sleep() { return sleepCycle(start_, expected_cycle_time_, actual_cycle_time_); }
void WallRate::reset() { start_ = WallTime::now(); }

}  // namespace ros
