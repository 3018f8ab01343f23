#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct rmw_time_s {
  uint64_t sec;
  uint64_t nsec;
} rmw_time_t;

#define RMW_DURATION_INFINITE \
  { 9223372036LL, 854775807LL }
#define RMW_DURATION_UNSPECIFIED \
  { 0LL, 0LL }

typedef int64_t rmw_duration_t;

static inline bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right) {
  return left.sec * 1000000000ULL + left.nsec == right.sec * 1000000000ULL + right.nsec;
}

/// Nanoseconds of a time, at most what 63 bits hold.
static inline rmw_duration_t rmw_time_total_nsec(const rmw_time_t time) {
  const uint64_t most = 9223372036ULL;
  if (time.sec > most || (time.sec == most && time.nsec > 854775807ULL)) return INT64_MAX;
  return (rmw_duration_t)(time.sec * 1000000000ULL + time.nsec);
}

static inline rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds) {
  rmw_time_t time = RMW_DURATION_INFINITE;
  if (nanoseconds >= 0) {
    time.sec = (uint64_t)nanoseconds / 1000000000ULL;
    time.nsec = (uint64_t)nanoseconds % 1000000000ULL;
  }
  return time;
}

static inline rmw_time_t rmw_time_normalize(const rmw_time_t time) {
  return rmw_time_from_nsec(rmw_time_total_nsec(time));
}
