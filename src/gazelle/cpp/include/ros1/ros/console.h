#pragma once
// Log macros of ROS 1. A place that logs is a static object of the function: asking whether it is
// heard costs two loads; what is heard goes to the console, the log file and /rosout.

#include <ros/console_sites.h>
#include <ros/macros.h>
#include <ros/time.h>

#include <boost/shared_ptr.hpp>

#include <cstdarg>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#ifdef ROS_PACKAGE_NAME
#define ROSCONSOLE_PACKAGE_NAME ROS_PACKAGE_NAME
#else
#define ROSCONSOLE_PACKAGE_NAME "unknown_package"
#endif
#define ROSCONSOLE_ROOT_LOGGER_NAME "ros"
#define ROSCONSOLE_NAME_PREFIX ROSCONSOLE_ROOT_LOGGER_NAME "." ROSCONSOLE_PACKAGE_NAME
#define ROSCONSOLE_DEFAULT_NAME ROSCONSOLE_NAME_PREFIX

// What is below the lowest severity is not even compiled.
#define ROSCONSOLE_SEVERITY_DEBUG 0
#define ROSCONSOLE_SEVERITY_INFO 1
#define ROSCONSOLE_SEVERITY_WARN 2
#define ROSCONSOLE_SEVERITY_ERROR 3
#define ROSCONSOLE_SEVERITY_FATAL 4
#define ROSCONSOLE_SEVERITY_NONE 5
#ifndef ROSCONSOLE_MIN_SEVERITY
#define ROSCONSOLE_MIN_SEVERITY ROSCONSOLE_SEVERITY_DEBUG
#endif

#define ROSCONSOLE_AUTOINIT \
  do {                      \
  } while (false)

#define GAZELLE_ROS_COMPILED(level) (static_cast<int>(level) >= ROSCONSOLE_MIN_SEVERITY)
// The static place of a macro; the name may be computed, as in roscpp: its first value counts.
#define GAZELLE_ROS_SITE(level, name)                           \
  static ::ros::console::LogSite gazelle_log_site(name, level); \
  const bool gazelle_is_heard = GAZELLE_ROS_COMPILED(level) && gazelle_log_site.isHeard()
#define GAZELLE_ROS_PRINT(...) \
  ::ros::console::print(gazelle_log_site, __FILE__, __LINE__, __PRETTY_FUNCTION__, __VA_ARGS__)
#define GAZELLE_ROS_STREAM(args)                                                         \
  do {                                                                                   \
    std::stringstream gazelle_log_text;                                                  \
    gazelle_log_text << args;                                                            \
    ::ros::console::printText(gazelle_log_site, __FILE__, __LINE__, __PRETTY_FUNCTION__, \
                              gazelle_log_text.str());                                   \
  } while (false)

#define ROS_LOG_COND(cond, level, name, ...)                        \
  do {                                                              \
    GAZELLE_ROS_SITE(level, name);                                  \
    if (gazelle_is_heard && (cond)) GAZELLE_ROS_PRINT(__VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_COND(cond, level, name, args)          \
  do {                                                        \
    GAZELLE_ROS_SITE(level, name);                            \
    if (gazelle_is_heard && (cond)) GAZELLE_ROS_STREAM(args); \
  } while (false)
#define ROS_LOG_ONCE(level, name, ...)                                                  \
  do {                                                                                  \
    GAZELLE_ROS_SITE(level, name);                                                      \
    if (gazelle_is_heard && gazelle_log_site.isFirst()) GAZELLE_ROS_PRINT(__VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_ONCE(level, name, args)                                    \
  do {                                                                            \
    GAZELLE_ROS_SITE(level, name);                                                \
    if (gazelle_is_heard && gazelle_log_site.isFirst()) GAZELLE_ROS_STREAM(args); \
  } while (false)
#define ROS_LOG_THROTTLE(period, level, name, ...)                                                 \
  do {                                                                                             \
    GAZELLE_ROS_SITE(level, name);                                                                 \
    if (gazelle_is_heard && gazelle_log_site.isDue(period, false)) GAZELLE_ROS_PRINT(__VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_THROTTLE(period, level, name, args)                                   \
  do {                                                                                       \
    GAZELLE_ROS_SITE(level, name);                                                           \
    if (gazelle_is_heard && gazelle_log_site.isDue(period, false)) GAZELLE_ROS_STREAM(args); \
  } while (false)
#define ROS_LOG_DELAYED_THROTTLE(period, level, name, ...)                                        \
  do {                                                                                            \
    GAZELLE_ROS_SITE(level, name);                                                                \
    if (gazelle_is_heard && gazelle_log_site.isDue(period, true)) GAZELLE_ROS_PRINT(__VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_DELAYED_THROTTLE(period, level, name, args)                          \
  do {                                                                                      \
    GAZELLE_ROS_SITE(level, name);                                                          \
    if (gazelle_is_heard && gazelle_log_site.isDue(period, true)) GAZELLE_ROS_STREAM(args); \
  } while (false)
#define ROS_LOG_FILTER(filter, level, name, ...)                                                 \
  do {                                                                                           \
    GAZELLE_ROS_SITE(level, name);                                                               \
    if (gazelle_is_heard && (filter)->isEnabled())                                               \
      ::ros::console::print((filter), gazelle_log_site, __FILE__, __LINE__, __PRETTY_FUNCTION__, \
                            __VA_ARGS__);                                                        \
  } while (false)
#define ROS_LOG_STREAM_FILTER(filter, level, name, args)                                         \
  do {                                                                                           \
    GAZELLE_ROS_SITE(level, name);                                                               \
    if (gazelle_is_heard && (filter)->isEnabled()) {                                             \
      std::stringstream gazelle_log_text;                                                        \
      gazelle_log_text << args;                                                                  \
      ::ros::console::print((filter), gazelle_log_site, __FILE__, __LINE__, __PRETTY_FUNCTION__, \
                            "%s", gazelle_log_text.str().c_str());                               \
    }                                                                                            \
  } while (false)
#define ROS_LOG(level, name, ...) ROS_LOG_COND(true, level, name, __VA_ARGS__)
#define ROS_LOG_STREAM(level, name, args) ROS_LOG_STREAM_COND(true, level, name, args)

#include <rosconsole/macros_generated.h>
