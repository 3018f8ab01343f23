#pragma once

#define ROS_COMPILE_ASSERT(condition) static_assert(condition, #condition)
#ifndef ROS_STATIC_ASSERT
#define ROS_STATIC_ASSERT(condition) static_assert(condition, #condition)
#endif
