#pragma once

#include <ros/macros.h>

#include <stdexcept>
#include <string>

namespace XmlRpc {

/// A value was taken for what it is not.
class XMLRPCPP_DECL XmlRpcException {
 public:
  XmlRpcException(const std::string& message, int code = -1) : message_(message), code_(code) {}
  const std::string& getMessage() const { return message_; }
  int getCode() const { return code_; }

 private:
  std::string message_;
  int code_;
};

}  // namespace XmlRpc
