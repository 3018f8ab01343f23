#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <sstream>
#include <type_traits>

#include "rclcpp/clock.hpp"
#include "rclcpp/logger.hpp"
#include "rclcpp/utilities.hpp"
#include "rcutils/logging.h"
#include "rcutils/logging_macros.h"

#define RCLCPP_LOG_MIN_SEVERITY_DEBUG 0
#define RCLCPP_LOG_MIN_SEVERITY_INFO 1
#define RCLCPP_LOG_MIN_SEVERITY_WARN 2
#define RCLCPP_LOG_MIN_SEVERITY_ERROR 3
#define RCLCPP_LOG_MIN_SEVERITY_FATAL 4
#define RCLCPP_LOG_MIN_SEVERITY_NONE 5

#ifndef RCLCPP_LOG_MIN_SEVERITY
#define RCLCPP_LOG_MIN_SEVERITY RCLCPP_LOG_MIN_SEVERITY_DEBUG
#endif

namespace rclcpp {
namespace detail {

/// State of one place in a program that says something only now and then.
struct ThrottledPlace {
  /// Tell whether the place may speak again, and note when it did.
  RCLCPP_PUBLIC bool may_speak(const Clock& clock, double duration_ms);
  RCLCPP_PUBLIC bool is_first();
  std::atomic<bool> seen{false};
  std::atomic<bool> spoken{false};
  std::atomic<std::int64_t> last_ns{0};
};

}  // namespace detail
}  // namespace rclcpp

// What all macros are: the severity, whether to speak (asked once the level allows it), the
// logger, and printf's words or a stream's.
#define GAZELLE_RCLCPP_LOG(severity, condition, logger, ...)                                   \
  do {                                                                                         \
    static_assert(                                                                             \
        ::std::is_same<                                                                        \
            typename std::remove_cv_t<typename std::remove_reference_t<decltype(logger)>>,     \
            typename ::rclcpp::Logger>::value,                                                 \
        "First argument to logging macros must be an rclcpp::Logger");                         \
    static const rcutils_log_location_t gazelle_log_location = {__func__, __FILE__, __LINE__}; \
    static ::rclcpp::detail::ThrottledPlace gazelle_log_place;                                 \
    (void)gazelle_log_place;                                                                   \
    const auto& gazelle_logger = logger;                                                       \
    if (rcutils_logging_logger_is_enabled_for(gazelle_logger.get_name(), severity) &&          \
        (condition)) {                                                                         \
      rcutils_log(&gazelle_log_location, severity, gazelle_logger.get_name(), __VA_ARGS__);    \
    }                                                                                          \
  } while (0)

#define GAZELLE_RCLCPP_LOG_STREAM(severity, condition, logger, words)                          \
  do {                                                                                         \
    static_assert(                                                                             \
        ::std::is_same<                                                                        \
            typename std::remove_cv_t<typename std::remove_reference_t<decltype(logger)>>,     \
            typename ::rclcpp::Logger>::value,                                                 \
        "First argument to logging macros must be an rclcpp::Logger");                         \
    static const rcutils_log_location_t gazelle_log_location = {__func__, __FILE__, __LINE__}; \
    static ::rclcpp::detail::ThrottledPlace gazelle_log_place;                                 \
    (void)gazelle_log_place;                                                                   \
    const auto& gazelle_logger = logger;                                                       \
    if (rcutils_logging_logger_is_enabled_for(gazelle_logger.get_name(), severity) &&          \
        (condition)) {                                                                         \
      std::stringstream rclcpp_stream_ss_;                                                     \
      rclcpp_stream_ss_ << words;                                                              \
      rcutils_log(&gazelle_log_location, severity, gazelle_logger.get_name(), "%s",            \
                  rclcpp_stream_ss_.str().c_str());                                            \
    }                                                                                          \
  } while (0)

#define GAZELLE_RCLCPP_ONCE !gazelle_log_place.spoken.exchange(true)
#define GAZELLE_RCLCPP_SKIPFIRST !gazelle_log_place.is_first()
#define GAZELLE_RCLCPP_THROTTLE(clock, duration) \
  gazelle_log_place.may_speak((clock), static_cast<double>(duration))
#define GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration)               \
  gazelle_log_place.may_speak((clock), static_cast<double>(duration)) && \
      !gazelle_log_place.is_first()

#if RCLCPP_LOG_MIN_SEVERITY > RCLCPP_LOG_MIN_SEVERITY_DEBUG
#define RCLCPP_DEBUG(...)
#define RCLCPP_DEBUG_STREAM(...)
#define RCLCPP_DEBUG_ONCE(...)
#define RCLCPP_DEBUG_STREAM_ONCE(...)
#define RCLCPP_DEBUG_EXPRESSION(...)
#define RCLCPP_DEBUG_STREAM_EXPRESSION(...)
#define RCLCPP_DEBUG_FUNCTION(...)
#define RCLCPP_DEBUG_STREAM_FUNCTION(...)
#define RCLCPP_DEBUG_SKIPFIRST(...)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST(...)
#define RCLCPP_DEBUG_THROTTLE(...)
#define RCLCPP_DEBUG_STREAM_THROTTLE(...)
#define RCLCPP_DEBUG_SKIPFIRST_THROTTLE(...)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST_THROTTLE(...)
#else
#define RCLCPP_DEBUG(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, true, logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, true, logger, stream_arg)
#define RCLCPP_DEBUG_ONCE(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_ONCE, logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_ONCE(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_ONCE, logger, stream_arg)
#define RCLCPP_DEBUG_EXPRESSION(logger, expression, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, (expression), logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_EXPRESSION(logger, expression, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, (expression), logger, stream_arg)
#define RCLCPP_DEBUG_FUNCTION(logger, function, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, (*(function))(), logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_FUNCTION(logger, function, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, (*(function))(), logger, stream_arg)
#define RCLCPP_DEBUG_SKIPFIRST(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_SKIPFIRST, logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST(logger, stream_arg)                                 \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_SKIPFIRST, logger, \
                            stream_arg)
#define RCLCPP_DEBUG_THROTTLE(logger, clock, duration, ...)                                        \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_THROTTLE(clock, duration), logger, \
                     __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_THROTTLE(logger, clock, duration, stream_arg)                         \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG, GAZELLE_RCLCPP_THROTTLE(clock, duration), \
                            logger, stream_arg)
#define RCLCPP_DEBUG_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_DEBUG,                      \
                     GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg)     \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_DEBUG,                                 \
                            GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, \
                            stream_arg)
#endif

#if RCLCPP_LOG_MIN_SEVERITY > RCLCPP_LOG_MIN_SEVERITY_INFO
#define RCLCPP_INFO(...)
#define RCLCPP_INFO_STREAM(...)
#define RCLCPP_INFO_ONCE(...)
#define RCLCPP_INFO_STREAM_ONCE(...)
#define RCLCPP_INFO_EXPRESSION(...)
#define RCLCPP_INFO_STREAM_EXPRESSION(...)
#define RCLCPP_INFO_FUNCTION(...)
#define RCLCPP_INFO_STREAM_FUNCTION(...)
#define RCLCPP_INFO_SKIPFIRST(...)
#define RCLCPP_INFO_STREAM_SKIPFIRST(...)
#define RCLCPP_INFO_THROTTLE(...)
#define RCLCPP_INFO_STREAM_THROTTLE(...)
#define RCLCPP_INFO_SKIPFIRST_THROTTLE(...)
#define RCLCPP_INFO_STREAM_SKIPFIRST_THROTTLE(...)
#else
#define RCLCPP_INFO(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, true, logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, true, logger, stream_arg)
#define RCLCPP_INFO_ONCE(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_ONCE, logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_ONCE(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_ONCE, logger, stream_arg)
#define RCLCPP_INFO_EXPRESSION(logger, expression, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, (expression), logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_EXPRESSION(logger, expression, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, (expression), logger, stream_arg)
#define RCLCPP_INFO_FUNCTION(logger, function, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, (*(function))(), logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_FUNCTION(logger, function, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, (*(function))(), logger, stream_arg)
#define RCLCPP_INFO_SKIPFIRST(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_SKIPFIRST, logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_SKIPFIRST, logger, stream_arg)
#define RCLCPP_INFO_THROTTLE(logger, clock, duration, ...)                                        \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_THROTTLE(clock, duration), logger, \
                     __VA_ARGS__)
#define RCLCPP_INFO_STREAM_THROTTLE(logger, clock, duration, stream_arg)                         \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO, GAZELLE_RCLCPP_THROTTLE(clock, duration), \
                            logger, stream_arg)
#define RCLCPP_INFO_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_INFO,                      \
                     GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg)      \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_INFO,                                  \
                            GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, \
                            stream_arg)
#endif

#if RCLCPP_LOG_MIN_SEVERITY > RCLCPP_LOG_MIN_SEVERITY_WARN
#define RCLCPP_WARN(...)
#define RCLCPP_WARN_STREAM(...)
#define RCLCPP_WARN_ONCE(...)
#define RCLCPP_WARN_STREAM_ONCE(...)
#define RCLCPP_WARN_EXPRESSION(...)
#define RCLCPP_WARN_STREAM_EXPRESSION(...)
#define RCLCPP_WARN_FUNCTION(...)
#define RCLCPP_WARN_STREAM_FUNCTION(...)
#define RCLCPP_WARN_SKIPFIRST(...)
#define RCLCPP_WARN_STREAM_SKIPFIRST(...)
#define RCLCPP_WARN_THROTTLE(...)
#define RCLCPP_WARN_STREAM_THROTTLE(...)
#define RCLCPP_WARN_SKIPFIRST_THROTTLE(...)
#define RCLCPP_WARN_STREAM_SKIPFIRST_THROTTLE(...)
#else
#define RCLCPP_WARN(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, true, logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, true, logger, stream_arg)
#define RCLCPP_WARN_ONCE(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_ONCE, logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_ONCE(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_ONCE, logger, stream_arg)
#define RCLCPP_WARN_EXPRESSION(logger, expression, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, (expression), logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_EXPRESSION(logger, expression, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, (expression), logger, stream_arg)
#define RCLCPP_WARN_FUNCTION(logger, function, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, (*(function))(), logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_FUNCTION(logger, function, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, (*(function))(), logger, stream_arg)
#define RCLCPP_WARN_SKIPFIRST(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_SKIPFIRST, logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_SKIPFIRST, logger, stream_arg)
#define RCLCPP_WARN_THROTTLE(logger, clock, duration, ...)                                        \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_THROTTLE(clock, duration), logger, \
                     __VA_ARGS__)
#define RCLCPP_WARN_STREAM_THROTTLE(logger, clock, duration, stream_arg)                         \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN, GAZELLE_RCLCPP_THROTTLE(clock, duration), \
                            logger, stream_arg)
#define RCLCPP_WARN_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_WARN,                      \
                     GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg)      \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_WARN,                                  \
                            GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, \
                            stream_arg)
#endif

#if RCLCPP_LOG_MIN_SEVERITY > RCLCPP_LOG_MIN_SEVERITY_ERROR
#define RCLCPP_ERROR(...)
#define RCLCPP_ERROR_STREAM(...)
#define RCLCPP_ERROR_ONCE(...)
#define RCLCPP_ERROR_STREAM_ONCE(...)
#define RCLCPP_ERROR_EXPRESSION(...)
#define RCLCPP_ERROR_STREAM_EXPRESSION(...)
#define RCLCPP_ERROR_FUNCTION(...)
#define RCLCPP_ERROR_STREAM_FUNCTION(...)
#define RCLCPP_ERROR_SKIPFIRST(...)
#define RCLCPP_ERROR_STREAM_SKIPFIRST(...)
#define RCLCPP_ERROR_THROTTLE(...)
#define RCLCPP_ERROR_STREAM_THROTTLE(...)
#define RCLCPP_ERROR_SKIPFIRST_THROTTLE(...)
#define RCLCPP_ERROR_STREAM_SKIPFIRST_THROTTLE(...)
#else
#define RCLCPP_ERROR(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, true, logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, true, logger, stream_arg)
#define RCLCPP_ERROR_ONCE(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_ONCE, logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_ONCE(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_ONCE, logger, stream_arg)
#define RCLCPP_ERROR_EXPRESSION(logger, expression, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, (expression), logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_EXPRESSION(logger, expression, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, (expression), logger, stream_arg)
#define RCLCPP_ERROR_FUNCTION(logger, function, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, (*(function))(), logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_FUNCTION(logger, function, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, (*(function))(), logger, stream_arg)
#define RCLCPP_ERROR_SKIPFIRST(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_SKIPFIRST, logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST(logger, stream_arg)                                 \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_SKIPFIRST, logger, \
                            stream_arg)
#define RCLCPP_ERROR_THROTTLE(logger, clock, duration, ...)                                        \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_THROTTLE(clock, duration), logger, \
                     __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_THROTTLE(logger, clock, duration, stream_arg)                         \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR, GAZELLE_RCLCPP_THROTTLE(clock, duration), \
                            logger, stream_arg)
#define RCLCPP_ERROR_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_ERROR,                      \
                     GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg)     \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_ERROR,                                 \
                            GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, \
                            stream_arg)
#endif

#if RCLCPP_LOG_MIN_SEVERITY > RCLCPP_LOG_MIN_SEVERITY_FATAL
#define RCLCPP_FATAL(...)
#define RCLCPP_FATAL_STREAM(...)
#define RCLCPP_FATAL_ONCE(...)
#define RCLCPP_FATAL_STREAM_ONCE(...)
#define RCLCPP_FATAL_EXPRESSION(...)
#define RCLCPP_FATAL_STREAM_EXPRESSION(...)
#define RCLCPP_FATAL_FUNCTION(...)
#define RCLCPP_FATAL_STREAM_FUNCTION(...)
#define RCLCPP_FATAL_SKIPFIRST(...)
#define RCLCPP_FATAL_STREAM_SKIPFIRST(...)
#define RCLCPP_FATAL_THROTTLE(...)
#define RCLCPP_FATAL_STREAM_THROTTLE(...)
#define RCLCPP_FATAL_SKIPFIRST_THROTTLE(...)
#define RCLCPP_FATAL_STREAM_SKIPFIRST_THROTTLE(...)
#else
#define RCLCPP_FATAL(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, true, logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, true, logger, stream_arg)
#define RCLCPP_FATAL_ONCE(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_ONCE, logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_ONCE(logger, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_ONCE, logger, stream_arg)
#define RCLCPP_FATAL_EXPRESSION(logger, expression, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, (expression), logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_EXPRESSION(logger, expression, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, (expression), logger, stream_arg)
#define RCLCPP_FATAL_FUNCTION(logger, function, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, (*(function))(), logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_FUNCTION(logger, function, stream_arg) \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, (*(function))(), logger, stream_arg)
#define RCLCPP_FATAL_SKIPFIRST(logger, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_SKIPFIRST, logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST(logger, stream_arg)                                 \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_SKIPFIRST, logger, \
                            stream_arg)
#define RCLCPP_FATAL_THROTTLE(logger, clock, duration, ...)                                        \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_THROTTLE(clock, duration), logger, \
                     __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_THROTTLE(logger, clock, duration, stream_arg)                         \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL, GAZELLE_RCLCPP_THROTTLE(clock, duration), \
                            logger, stream_arg)
#define RCLCPP_FATAL_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  GAZELLE_RCLCPP_LOG(RCUTILS_LOG_SEVERITY_FATAL,                      \
                     GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg)     \
  GAZELLE_RCLCPP_LOG_STREAM(RCUTILS_LOG_SEVERITY_FATAL,                                 \
                            GAZELLE_RCLCPP_SKIPFIRST_THROTTLE(clock, duration), logger, \
                            stream_arg)
#endif
