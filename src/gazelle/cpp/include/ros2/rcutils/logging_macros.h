#pragma once

#include "rcutils/logging.h"
#include "rcutils/time.h"

// Every macro below is this one with a severity, a condition and a name.
#define RCUTILS_LOG_COND_NAMED(severity, condition_before, condition_after, name, ...)   \
  do {                                                                                   \
    static rcutils_log_location_t gazelle_log_location = {__func__, __FILE__, __LINE__}; \
    if (rcutils_logging_logger_is_enabled_for(name, severity)) {                         \
      condition_before rcutils_log(&gazelle_log_location, severity, name, __VA_ARGS__);  \
      condition_after                                                                    \
    }                                                                                    \
  } while (0)

#define RCUTILS_LOG_CONDITION_EMPTY
#define RCUTILS_LOG_CONDITION_ONCE_BEFORE \
  static int gazelle_log_once = 0;        \
  if (!gazelle_log_once) {                \
    gazelle_log_once = 1;
#define RCUTILS_LOG_CONDITION_ONCE_AFTER }
#define RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression) if (expression) {
#define RCUTILS_LOG_CONDITION_EXPRESSION_AFTER }
#define RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function) if ((*(function))()) {
#define RCUTILS_LOG_CONDITION_FUNCTION_AFTER }
#define RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE \
  static int gazelle_log_first = 1;            \
  if (gazelle_log_first) {                     \
    gazelle_log_first = 0;                     \
  } else {
#define RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER }
#define RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms)                         \
  static rcutils_time_point_value_t gazelle_log_last = 0;                                 \
  rcutils_time_point_value_t gazelle_log_now = 0;                                         \
  if (clock(&gazelle_log_now) == RCUTILS_RET_OK &&                                        \
      (!gazelle_log_last ||                                                               \
       gazelle_log_now >= gazelle_log_last + RCUTILS_MS_TO_NS((int64_t)(duration_ms)))) { \
    gazelle_log_last = gazelle_log_now;
#define RCUTILS_LOG_CONDITION_THROTTLE_AFTER }

#define RCUTILS_LOG_DEBUG(...) RCUTILS_LOG_DEBUG_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_NAMED(name, ...) \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG, , , name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE(...) RCUTILS_LOG_DEBUG_ONCE_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG, RCUTILS_LOG_CONDITION_ONCE_BEFORE, \
                         RCUTILS_LOG_CONDITION_ONCE_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION(expression, ...) \
  RCUTILS_LOG_DEBUG_EXPRESSION_NAMED(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION_NAMED(expression, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG,                          \
                         RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression), \
                         RCUTILS_LOG_CONDITION_EXPRESSION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION(function, ...) \
  RCUTILS_LOG_DEBUG_FUNCTION_NAMED(function, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION_NAMED(function, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG,                      \
                         RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function), \
                         RCUTILS_LOG_CONDITION_FUNCTION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST(...) RCUTILS_LOG_DEBUG_SKIPFIRST_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG, RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE, \
                         RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE(clock, duration_ms, ...) \
  RCUTILS_LOG_DEBUG_THROTTLE_NAMED(clock, duration_ms, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE_NAMED(clock, duration_ms, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_DEBUG,                                \
                         RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms), \
                         RCUTILS_LOG_CONDITION_THROTTLE_AFTER, name, __VA_ARGS__)

#define RCUTILS_LOG_INFO(...) RCUTILS_LOG_INFO_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_NAMED(name, ...) \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO, , , name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE(...) RCUTILS_LOG_INFO_ONCE_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO, RCUTILS_LOG_CONDITION_ONCE_BEFORE, \
                         RCUTILS_LOG_CONDITION_ONCE_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION(expression, ...) \
  RCUTILS_LOG_INFO_EXPRESSION_NAMED(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION_NAMED(expression, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO,                           \
                         RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression), \
                         RCUTILS_LOG_CONDITION_EXPRESSION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION(function, ...) \
  RCUTILS_LOG_INFO_FUNCTION_NAMED(function, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION_NAMED(function, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO,                       \
                         RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function), \
                         RCUTILS_LOG_CONDITION_FUNCTION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST(...) RCUTILS_LOG_INFO_SKIPFIRST_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO, RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE, \
                         RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE(clock, duration_ms, ...) \
  RCUTILS_LOG_INFO_THROTTLE_NAMED(clock, duration_ms, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE_NAMED(clock, duration_ms, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_INFO,                                 \
                         RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms), \
                         RCUTILS_LOG_CONDITION_THROTTLE_AFTER, name, __VA_ARGS__)

#define RCUTILS_LOG_WARN(...) RCUTILS_LOG_WARN_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_NAMED(name, ...) \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN, , , name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE(...) RCUTILS_LOG_WARN_ONCE_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN, RCUTILS_LOG_CONDITION_ONCE_BEFORE, \
                         RCUTILS_LOG_CONDITION_ONCE_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION(expression, ...) \
  RCUTILS_LOG_WARN_EXPRESSION_NAMED(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION_NAMED(expression, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN,                           \
                         RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression), \
                         RCUTILS_LOG_CONDITION_EXPRESSION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION(function, ...) \
  RCUTILS_LOG_WARN_FUNCTION_NAMED(function, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION_NAMED(function, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN,                       \
                         RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function), \
                         RCUTILS_LOG_CONDITION_FUNCTION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST(...) RCUTILS_LOG_WARN_SKIPFIRST_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN, RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE, \
                         RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE(clock, duration_ms, ...) \
  RCUTILS_LOG_WARN_THROTTLE_NAMED(clock, duration_ms, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE_NAMED(clock, duration_ms, name, ...)              \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_WARN,                                 \
                         RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms), \
                         RCUTILS_LOG_CONDITION_THROTTLE_AFTER, name, __VA_ARGS__)

#define RCUTILS_LOG_ERROR(...) RCUTILS_LOG_ERROR_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_NAMED(name, ...) \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR, , , name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE(...) RCUTILS_LOG_ERROR_ONCE_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR, RCUTILS_LOG_CONDITION_ONCE_BEFORE, \
                         RCUTILS_LOG_CONDITION_ONCE_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION(expression, ...) \
  RCUTILS_LOG_ERROR_EXPRESSION_NAMED(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION_NAMED(expression, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR,                          \
                         RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression), \
                         RCUTILS_LOG_CONDITION_EXPRESSION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION(function, ...) \
  RCUTILS_LOG_ERROR_FUNCTION_NAMED(function, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION_NAMED(function, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR,                      \
                         RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function), \
                         RCUTILS_LOG_CONDITION_FUNCTION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST(...) RCUTILS_LOG_ERROR_SKIPFIRST_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR, RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE, \
                         RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE(clock, duration_ms, ...) \
  RCUTILS_LOG_ERROR_THROTTLE_NAMED(clock, duration_ms, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE_NAMED(clock, duration_ms, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_ERROR,                                \
                         RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms), \
                         RCUTILS_LOG_CONDITION_THROTTLE_AFTER, name, __VA_ARGS__)

#define RCUTILS_LOG_FATAL(...) RCUTILS_LOG_FATAL_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_NAMED(name, ...) \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL, , , name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE(...) RCUTILS_LOG_FATAL_ONCE_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL, RCUTILS_LOG_CONDITION_ONCE_BEFORE, \
                         RCUTILS_LOG_CONDITION_ONCE_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION(expression, ...) \
  RCUTILS_LOG_FATAL_EXPRESSION_NAMED(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION_NAMED(expression, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL,                          \
                         RCUTILS_LOG_CONDITION_EXPRESSION_BEFORE(expression), \
                         RCUTILS_LOG_CONDITION_EXPRESSION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION(function, ...) \
  RCUTILS_LOG_FATAL_FUNCTION_NAMED(function, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION_NAMED(function, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL,                      \
                         RCUTILS_LOG_CONDITION_FUNCTION_BEFORE(function), \
                         RCUTILS_LOG_CONDITION_FUNCTION_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST(...) RCUTILS_LOG_FATAL_SKIPFIRST_NAMED(NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_NAMED(name, ...)                                         \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL, RCUTILS_LOG_CONDITION_SKIPFIRST_BEFORE, \
                         RCUTILS_LOG_CONDITION_SKIPFIRST_AFTER, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE(clock, duration_ms, ...) \
  RCUTILS_LOG_FATAL_THROTTLE_NAMED(clock, duration_ms, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE_NAMED(clock, duration_ms, name, ...)             \
  RCUTILS_LOG_COND_NAMED(RCUTILS_LOG_SEVERITY_FATAL,                                \
                         RCUTILS_LOG_CONDITION_THROTTLE_BEFORE(clock, duration_ms), \
                         RCUTILS_LOG_CONDITION_THROTTLE_AFTER, name, __VA_ARGS__)
