#pragma once

#include <ros/common.h>

#include <cstdint>

namespace ros {

typedef std::int8_t int8_t;
typedef std::uint8_t uint8_t;

}  // namespace ros
