#pragma once

#include <rosbag/macros.h>

#include <stdexcept>
#include <string>

namespace rosbag {

class BagException : public std::runtime_error {
 public:
  BagException(const std::string& message) : std::runtime_error(message) {}
};
class BagIOException : public BagException {
 public:
  BagIOException(const std::string& message) : BagException(message) {}
};
class BagFormatException : public BagException {
 public:
  BagFormatException(const std::string& message) : BagException(message) {}
};
class BagUnindexedException : public BagException {
 public:
  BagUnindexedException() : BagException("Bag unindexed") {}
};

}  // namespace rosbag
