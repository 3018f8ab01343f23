#pragma once

#include <memory>

#include "rclcpp/macros.hpp"
#include "rclcpp/serialized_message.hpp"

namespace rclcpp {
namespace message_memory_strategy {

/// Where messages for a subscription come from.
template <typename MessageT, typename Alloc = std::allocator<void>>
class MessageMemoryStrategy {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MessageMemoryStrategy)
  MessageMemoryStrategy() = default;
  explicit MessageMemoryStrategy(std::shared_ptr<Alloc>) {}
  virtual ~MessageMemoryStrategy() = default;
  static SharedPtr create_default() { return std::make_shared<MessageMemoryStrategy>(); }
  virtual std::shared_ptr<MessageT> borrow_message() { return std::make_shared<MessageT>(); }
  virtual std::shared_ptr<SerializedMessage> borrow_serialized_message(std::size_t capacity) {
    return std::make_shared<SerializedMessage>(capacity);
  }
  virtual std::shared_ptr<SerializedMessage> borrow_serialized_message() {
    return borrow_serialized_message(0);
  }
  virtual void return_message(std::shared_ptr<MessageT>& message) { message.reset(); }
  virtual void return_serialized_message(std::shared_ptr<SerializedMessage>& message) {
    message.reset();
  }
};

}  // namespace message_memory_strategy
}  // namespace rclcpp
