#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rcl/types.h"
#include "rclcpp/visibility_control.hpp"
#include "rcutils/logging.h"

#ifndef RCLCPP_LOGGING_ENABLED
#define RCLCPP_LOGGING_ENABLED 1
#endif

namespace rclcpp {

class Logger;
namespace node_interfaces {
class NodeLogging;
}

RCLCPP_PUBLIC Logger get_logger(const std::string& name);
RCLCPP_PUBLIC Logger get_node_logger(const void* node);

/// Says things under a name; the name's parts are split by dots.
class RCLCPP_PUBLIC Logger {
 public:
  enum class Level {
    Unset = RCUTILS_LOG_SEVERITY_UNSET,
    Debug = RCUTILS_LOG_SEVERITY_DEBUG,
    Info = RCUTILS_LOG_SEVERITY_INFO,
    Warn = RCUTILS_LOG_SEVERITY_WARN,
    Error = RCUTILS_LOG_SEVERITY_ERROR,
    Fatal = RCUTILS_LOG_SEVERITY_FATAL
  };

  Logger(const Logger&) = default;
  Logger& operator=(const Logger&) = default;

  const char* get_name() const { return name_ ? name_->c_str() : nullptr; }
  Logger get_child(const std::string& suffix);
  void set_level(Level level);
  Level get_effective_level() const;

 private:
  friend Logger get_logger(const std::string& name);
  Logger() = default;
  explicit Logger(const std::string& name) : name_(std::make_shared<const std::string>(name)) {}
  std::shared_ptr<const std::string> name_;
};

}  // namespace rclcpp
