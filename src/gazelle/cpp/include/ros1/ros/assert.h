#pragma once

#include <ros/console.h>
#include <ros/static_assert.h>

#include <csignal>

#define ROS_ISSUE_BREAK() std::raise(SIGTRAP)

#ifdef NDEBUG
#define ROS_ASSERT_ENABLED 0
#else
#define ROS_ASSERT_ENABLED 1
#endif

#if ROS_ASSERT_ENABLED
#define ROS_BREAK()                                                            \
  do {                                                                         \
    ROS_FATAL("BREAKPOINT HIT\n\tfile = %s\n\tline=%d\n", __FILE__, __LINE__); \
    ROS_ISSUE_BREAK();                                                         \
  } while (false)
#define ROS_ASSERT(condition)                                                                    \
  do {                                                                                           \
    if (!(condition)) {                                                                          \
      ROS_FATAL("ASSERTION FAILED\n\tfile = %s\n\tline = %d\n\tcond = %s\n", __FILE__, __LINE__, \
                #condition);                                                                     \
      ROS_ISSUE_BREAK();                                                                         \
    }                                                                                            \
  } while (false)
#define ROS_ASSERT_MSG(condition, ...)                                                             \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      ROS_FATAL("ASSERTION FAILED\n\tfile = %s\n\tline = %d\n\tcond = %s\n\tmessage = ", __FILE__, \
                __LINE__, #condition);                                                             \
      ROS_FATAL(__VA_ARGS__);                                                                      \
      ROS_ISSUE_BREAK();                                                                           \
    }                                                                                              \
  } while (false)
#define ROS_ASSERT_CMD(condition, command) \
  do {                                     \
    if (!(condition)) {                    \
      command;                             \
    }                                      \
  } while (false)
#else
#define ROS_BREAK()
#define ROS_ASSERT(condition)
#define ROS_ASSERT_MSG(condition, ...)
#define ROS_ASSERT_CMD(condition, command)
#endif
