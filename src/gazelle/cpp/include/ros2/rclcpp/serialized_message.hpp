#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// A message as CDR with its header.
class RCLCPP_PUBLIC SerializedMessage {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(SerializedMessage)
  explicit SerializedMessage(const rcl_allocator_t& allocator = rcl_get_default_allocator());
  explicit SerializedMessage(std::size_t initial_capacity,
                             const rcl_allocator_t& allocator = rcl_get_default_allocator());
  SerializedMessage(const SerializedMessage& other);
  explicit SerializedMessage(const rcl_serialized_message_t& other);
  SerializedMessage(SerializedMessage&& other);
  explicit SerializedMessage(rcl_serialized_message_t&& other);
  SerializedMessage& operator=(const SerializedMessage& other);
  SerializedMessage& operator=(const rcl_serialized_message_t& other);
  SerializedMessage& operator=(SerializedMessage&& other);
  SerializedMessage& operator=(rcl_serialized_message_t&& other);
  virtual ~SerializedMessage();

  rcl_serialized_message_t& get_rcl_serialized_message() { return message_; }
  const rcl_serialized_message_t& get_rcl_serialized_message() const { return message_; }
  std::size_t size() const { return message_.buffer_length; }
  std::size_t capacity() const { return message_.buffer_capacity; }
  void reserve(std::size_t capacity);
  rcl_serialized_message_t release_rcl_serialized_message();

  /// Hold a copy of some bytes.
  void assign(const void* data, std::size_t size);

 private:
  rcl_serialized_message_t message_;
};

}  // namespace rclcpp
