#pragma once

#include <ros/macros.h>

#include <stdexcept>
#include <string>

namespace ros {

/// What every exception of roscpp is.
class ROSCPP_DECL Exception : public std::runtime_error {
 public:
  Exception(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace ros
