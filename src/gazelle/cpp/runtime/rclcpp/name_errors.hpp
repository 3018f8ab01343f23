// The core's refusals of names, as rclcpp's exceptions.
#pragma once

#include <string>

#include "gazelle/core.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {
namespace detail {

inline bool is_name_error(const gazelle::Error& error) {
  return error.kind.find("Name") != std::string::npos;
}

template <class Function>
void with_topic_errors(const std::string& topic, Function&& function) {
  try {
    function();
  } catch (const gazelle::Error& error) {
    if (is_name_error(error))
      throw exceptions::InvalidTopicNameError(topic.c_str(), error.what(), 0);
    throw exceptions::RCLError(RCL_RET_ERROR, error.what());
  }
}

template <class Function>
void with_service_errors(const std::string& service, Function&& function) {
  try {
    function();
  } catch (const gazelle::Error& error) {
    if (is_name_error(error)) {
      throw exceptions::InvalidServiceNameError(service.c_str(), error.what(), 0);
    }
    throw exceptions::RCLError(RCL_RET_ERROR, error.what());
  }
}

}  // namespace detail
}  // namespace rclcpp
