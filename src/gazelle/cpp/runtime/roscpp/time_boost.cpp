// Times and spans as those of Boost.

#include <ros/time.h>
#include <boost/date_time/posix_time/posix_time_types.hpp>

namespace ros {

namespace {

namespace posix = boost::posix_time;

const posix::ptime& epoch() {
  static const posix::ptime begin(boost::gregorian::date(1970, 1, 1));
  return begin;
}

posix::time_duration spanOf(int64_t nanoseconds) {
#if defined(BOOST_DATE_TIME_HAS_NANOSECONDS)
  return posix::nanoseconds(nanoseconds);
#else
  return posix::microseconds(nanoseconds / 1000);
#endif
}

int64_t nanosecondsOf(const posix::time_duration& span) {
  return span.total_seconds() * 1000000000ll +
         span.fractional_seconds() * (1000000000ll / posix::time_duration::ticks_per_second());
}

}  // namespace

template <class T>
posix::time_duration DurationBase<T>::toBoost() const {
  return spanOf(toNSec());
}
template posix::time_duration DurationBase<Duration>::toBoost() const;
template posix::time_duration DurationBase<WallDuration>::toBoost() const;

template <class T, class D>
posix::ptime TimeBase<T, D>::toBoost() const {
  return epoch() + spanOf(static_cast<int64_t>(toNSec()));
}
template posix::ptime TimeBase<Time, Duration>::toBoost() const;
template posix::ptime TimeBase<WallTime, WallDuration>::toBoost() const;
template posix::ptime TimeBase<SteadyTime, WallDuration>::toBoost() const;

Time Time::fromBoost(const posix::ptime& time) { return fromBoost(time - epoch()); }
Time Time::fromBoost(const posix::time_duration& span) {
  Time time;
  return time.fromNSec(static_cast<uint64_t>(nanosecondsOf(span)));
}

}  // namespace ros
