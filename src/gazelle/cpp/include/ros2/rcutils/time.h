#pragma once

#include <stdint.h>
#include <time.h>

#include "rcutils/types/rcutils_ret.h"

#define RCUTILS_S_TO_NS(seconds) ((seconds) * (1000LL * 1000LL * 1000LL))
#define RCUTILS_MS_TO_NS(milliseconds) ((milliseconds) * (1000LL * 1000LL))
#define RCUTILS_US_TO_NS(microseconds) ((microseconds)*1000LL)
#define RCUTILS_NS_TO_S(nanoseconds) ((nanoseconds) / (1000LL * 1000LL * 1000LL))
#define RCUTILS_NS_TO_MS(nanoseconds) ((nanoseconds) / (1000LL * 1000LL))
#define RCUTILS_NS_TO_US(nanoseconds) ((nanoseconds) / 1000LL)

typedef int64_t rcutils_time_point_value_t;
typedef int64_t rcutils_duration_value_t;

static inline rcutils_ret_t gazelle_rcutils_clock(clockid_t which,
                                                  rcutils_time_point_value_t* now) {
  struct timespec read;
  if (!now) return RCUTILS_RET_INVALID_ARGUMENT;
  if (clock_gettime(which, &read) != 0) return RCUTILS_RET_ERROR;
  *now = RCUTILS_S_TO_NS((int64_t)read.tv_sec) + read.tv_nsec;
  return RCUTILS_RET_OK;
}

static inline rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t* now) {
  return gazelle_rcutils_clock(CLOCK_REALTIME, now);
}

static inline rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t* now) {
  return gazelle_rcutils_clock(CLOCK_MONOTONIC, now);
}
