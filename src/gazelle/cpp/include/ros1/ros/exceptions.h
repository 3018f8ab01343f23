#pragma once

#include <ros/exception.h>

namespace ros {

/// ros::init() was given what makes no node.
class ROSCPP_DECL InvalidNodeNameException : public Exception {
 public:
  InvalidNodeNameException(const std::string& name, const std::string& reason)
      : Exception("Invalid node name [" + name + "]: " + reason) {}
};

/// A name of the graph with characters that none may have.
class ROSCPP_DECL InvalidNameException : public Exception {
 public:
  InvalidNameException(const std::string& message) : Exception(message) {}
};

/// One topic, two types.
class ROSCPP_DECL ConflictingSubscriptionException : public Exception {
 public:
  ConflictingSubscriptionException(const std::string& message) : Exception(message) {}
};

/// A parameter that ROS 1 would not store.
class ROSCPP_DECL InvalidParameterException : public Exception {
 public:
  InvalidParameterException(const std::string& message) : Exception(message) {}
};

/// A port that is none.
class ROSCPP_DECL InvalidPortException : public Exception {
 public:
  InvalidPortException(const std::string& message) : Exception(message) {}
};

}  // namespace ros
