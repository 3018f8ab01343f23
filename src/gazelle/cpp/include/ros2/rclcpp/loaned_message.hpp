#pragma once

#include <memory>
#include <utility>

namespace rclcpp {

class PublisherBase;

/// A message that is filled in place: here its memory is the program's own.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class LoanedMessage {
 public:
  LoanedMessage(const PublisherBase& publisher, AllocatorT) : LoanedMessage(publisher) {}
  explicit LoanedMessage(const PublisherBase&) : message_(std::make_unique<MessageT>()) {}
  LoanedMessage(LoanedMessage&&) = default;
  virtual ~LoanedMessage() = default;
  bool is_valid() const { return message_ != nullptr; }
  MessageT& get() const { return *message_; }
  std::unique_ptr<MessageT> release() { return std::move(message_); }

 private:
  std::unique_ptr<MessageT> message_;
};

}  // namespace rclcpp
