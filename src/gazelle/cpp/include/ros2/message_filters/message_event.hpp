// A message with when it came.
#pragma once

#include <rclcpp/clock.hpp>
#include <rclcpp/time.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

namespace message_filters {

typedef std::map<std::string, std::string> M_string;
typedef std::shared_ptr<M_string> M_stringPtr;

template <typename M>
struct DefaultMessageCreator {
  std::shared_ptr<M> operator()() { return std::make_shared<M>(); }
};

template <typename M>
class MessageEvent {
 public:
  using ConstMessage = std::add_const_t<M>;
  using Message = std::remove_const_t<M>;
  using MessagePtr = std::shared_ptr<Message>;
  using ConstMessagePtr = std::shared_ptr<ConstMessage>;
  using CreateFunction = std::function<MessagePtr()>;

  MessageEvent() = default;
  MessageEvent(const MessageEvent<Message>& other) { take(other); }
  MessageEvent(const MessageEvent<ConstMessage>& other) { take(other); }
  MessageEvent(const MessageEvent<Message>& other, bool nonconst_need_copy) {
    take(other);
    nonconst_need_copy_ = nonconst_need_copy;
  }
  MessageEvent(const MessageEvent<ConstMessage>& other, bool nonconst_need_copy) {
    take(other);
    nonconst_need_copy_ = nonconst_need_copy;
  }
  MessageEvent(const ConstMessagePtr& message)  // NOLINT: as the original
      : message_(message), receipt_time_(rclcpp::Clock().now()) {}
  MessageEvent(const ConstMessagePtr& message, rclcpp::Time receipt_time)
      : message_(message), receipt_time_(receipt_time) {}
  MessageEvent(const ConstMessagePtr& message, rclcpp::Time receipt_time, bool nonconst_need_copy,
               const CreateFunction& create)
      : message_(message),
        receipt_time_(receipt_time),
        nonconst_need_copy_(nonconst_need_copy),
        create_(create) {}

  MessageEvent& operator=(const MessageEvent<Message>& other) {
    take(other);
    return *this;
  }
  MessageEvent& operator=(const MessageEvent<ConstMessage>& other) {
    take(other);
    return *this;
  }

  // The message; a copy of it where M is not const and others have it as well.
  std::shared_ptr<M> getMessage() const {
    if constexpr (std::is_void_v<Message> || std::is_const_v<M>) {
      return std::const_pointer_cast<M>(message_);
    } else {
      if (!nonconst_need_copy_) return std::const_pointer_cast<Message>(message_);
      if (!copy_ && message_) copy_ = std::make_shared<Message>(*message_);
      return copy_;
    }
  }
  const ConstMessagePtr& getConstMessage() const { return message_; }
  rclcpp::Time getReceiptTime() const { return receipt_time_; }
  bool nonConstWillCopy() const { return nonconst_need_copy_; }
  bool getMessageWillCopy() const { return !std::is_const_v<M> && nonconst_need_copy_; }
  const CreateFunction& getMessageFactory() const { return create_; }

  bool operator<(const MessageEvent<M>& other) const {
    if (message_ != other.message_) return message_ < other.message_;
    return receipt_time_.nanoseconds() < other.receipt_time_.nanoseconds();
  }
  bool operator==(const MessageEvent<M>& other) const {
    return message_ == other.message_ &&
           receipt_time_.nanoseconds() == other.receipt_time_.nanoseconds() &&
           nonconst_need_copy_ == other.nonconst_need_copy_;
  }
  bool operator!=(const MessageEvent<M>& other) const { return !(*this == other); }

 private:
  template <class Other>
  void take(const Other& other) {
    message_ = other.getConstMessage();
    receipt_time_ = other.getReceiptTime();
    nonconst_need_copy_ = other.nonConstWillCopy();
    create_ = other.getMessageFactory();
  }

  ConstMessagePtr message_;
  mutable MessagePtr copy_;
  rclcpp::Time receipt_time_;
  bool nonconst_need_copy_ = true;
  CreateFunction create_;
};

}  // namespace message_filters
