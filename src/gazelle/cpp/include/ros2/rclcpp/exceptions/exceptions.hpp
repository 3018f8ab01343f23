#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl/types.h"
#include "rclcpp/visibility_control.hpp"
#include "rcpputils/join.hpp"

namespace rclcpp {
namespace exceptions {

/// Something was asked of a node that is no more.
class InvalidNodeError : public std::runtime_error {
 public:
  InvalidNodeError() : std::runtime_error("node is invalid") {}
};

/// A name is not one of ROS's.
class NameValidationError : public std::invalid_argument {
 public:
  NameValidationError(const char* name_type, const char* name, const char* error_text,
                      std::size_t invalid_index)
      : std::invalid_argument(format_error(name_type, name, error_text, invalid_index)),
        name_type(name_type),
        name(name),
        error_msg(error_text),
        invalid_index(invalid_index) {}

  static std::string format_error(const char* name_type, const char* name, const char* error_text,
                                  std::size_t invalid_index) {
    return std::string("Invalid ") + name_type + ": " + error_text + ":\n  '" + name + "'\n   " +
           std::string(invalid_index, ' ') + "^\n";
  }

  const std::string name_type;
  const std::string name;
  const std::string error_msg;
  const std::size_t invalid_index;
};

class InvalidNodeNameError : public NameValidationError {
 public:
  InvalidNodeNameError(const char* name, const char* text, std::size_t index)
      : NameValidationError("node name", name, text, index) {}
};

class InvalidNamespaceError : public NameValidationError {
 public:
  InvalidNamespaceError(const char* name, const char* text, std::size_t index)
      : NameValidationError("namespace", name, text, index) {}
};

class InvalidTopicNameError : public NameValidationError {
 public:
  InvalidTopicNameError(const char* name, const char* text, std::size_t index)
      : NameValidationError("topic name", name, text, index) {}
};

class InvalidServiceNameError : public NameValidationError {
 public:
  InvalidServiceNameError(const char* name, const char* text, std::size_t index)
      : NameValidationError("service name", name, text, index) {}
};

class UnimplementedError : public std::runtime_error {
 public:
  UnimplementedError() : std::runtime_error("This code is unimplemented.") {}
  explicit UnimplementedError(const std::string& text) : std::runtime_error(text) {}
};

/// What an error of C was.
class RCLErrorBase {
 public:
  RCLErrorBase(rcl_ret_t code, const std::string& text)
      : ret(code), message(text), file(""), line(0), formatted_message(text) {}
  virtual ~RCLErrorBase() = default;

  rcl_ret_t ret;
  std::string message;
  std::string file;
  std::size_t line;
  std::string formatted_message;
};

class RCLError : public RCLErrorBase, public std::runtime_error {
 public:
  RCLError(rcl_ret_t code, const std::string& text)
      : RCLErrorBase(code, text), std::runtime_error(text) {}
  RCLError(const RCLErrorBase& base, const std::string& prefix)
      : RCLErrorBase(base),
        std::runtime_error(prefix + (prefix.empty() ? "" : ": ") + base.formatted_message) {}
};

class RCLBadAlloc : public RCLErrorBase, public std::bad_alloc {
 public:
  explicit RCLBadAlloc(const RCLErrorBase& base) : RCLErrorBase(base) {}
};

class RCLInvalidArgument : public RCLErrorBase, public std::invalid_argument {
 public:
  RCLInvalidArgument(rcl_ret_t code, const std::string& text)
      : RCLErrorBase(code, text), std::invalid_argument(text) {}
  RCLInvalidArgument(const RCLErrorBase& base, const std::string& prefix)
      : RCLErrorBase(base),
        std::invalid_argument(prefix + (prefix.empty() ? "" : ": ") + base.formatted_message) {}
};

class RCLInvalidROSArgsError : public RCLErrorBase, public std::runtime_error {
 public:
  RCLInvalidROSArgsError(rcl_ret_t code, const std::string& text)
      : RCLErrorBase(code, text), std::runtime_error(text) {}
};

class UnknownROSArgsError : public std::runtime_error {
 public:
  explicit UnknownROSArgsError(std::vector<std::string>&& unknown_in)
      : std::runtime_error("found unknown ROS arguments: '" + rcpputils::join(unknown_in, "', '") +
                           "'"),
        unknown_ros_args(unknown_in) {}
  const std::vector<std::string> unknown_ros_args;
};

class InvalidEventError : public std::runtime_error {
 public:
  InvalidEventError() : std::runtime_error("event is invalid") {}
};

class EventNotRegisteredError : public std::runtime_error {
 public:
  EventNotRegisteredError() : std::runtime_error("event already registered") {}
};

class InvalidParametersException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class InvalidParameterValueException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class InvalidParameterTypeException : public std::runtime_error {
 public:
  InvalidParameterTypeException(const std::string& name, const std::string& message)
      : std::runtime_error("parameter '" + name + "' has invalid type: " + message) {}
};

class UninitializedStaticallyTypedParameterException : public InvalidParameterTypeException {
 public:
  explicit UninitializedStaticallyTypedParameterException(const std::string& name)
      : InvalidParameterTypeException(name,
                                      "cannot declare a statically typed parameter with an "
                                      "uninitialized value") {}
};

class ParameterAlreadyDeclaredException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterNotDeclaredException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterImmutableException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterModifiedInCallbackException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterUninitializedException : public std::runtime_error {
 public:
  explicit ParameterUninitializedException(const std::string& name)
      : std::runtime_error("parameter '" + name + "' is not initialized") {}
};

class QoSCheckCompatibleException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class UnsupportedEventTypeException : public RCLErrorBase, public std::runtime_error {
 public:
  UnsupportedEventTypeException(rcl_ret_t code, const std::string& text)
      : RCLErrorBase(code, text), std::runtime_error(text) {}
};

/// Throw what a code of C means.
[[noreturn]] RCLCPP_PUBLIC void throw_from_rcl_error(rcl_ret_t code, const std::string& prefix = "",
                                                     const void* error_state = nullptr,
                                                     void (*reset_error)() = nullptr);

}  // namespace exceptions

using exceptions::UnsupportedEventTypeException;

}  // namespace rclcpp
