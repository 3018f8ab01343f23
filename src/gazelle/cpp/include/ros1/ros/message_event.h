#pragma once

#include <ros/datatypes.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/time.h>

#include <boost/function.hpp>
#include <boost/make_shared.hpp>

#include <string>
#include <type_traits>

namespace ros {

template <typename M>
struct DefaultMessageCreator {
  boost::shared_ptr<M> operator()() { return boost::make_shared<M>(); }
};

template <typename M>
ROS_DEPRECATED inline boost::shared_ptr<M> defaultMessageCreateFunction() {
  return DefaultMessageCreator<M>()();
}

/// A message with who sent it and when it came.
template <typename M>
class MessageEvent {
 public:
  typedef typename std::add_const<M>::type ConstMessage;
  typedef typename std::remove_const<M>::type Message;
  typedef boost::shared_ptr<Message> MessagePtr;
  typedef boost::shared_ptr<ConstMessage> ConstMessagePtr;
  typedef boost::function<MessagePtr()> CreateFunction;

  MessageEvent() : nonconst_need_copy_(true) {}
  MessageEvent(const MessageEvent<Message>& other) { *this = other; }
  MessageEvent(const MessageEvent<ConstMessage>& other) { *this = other; }
  MessageEvent(const MessageEvent<Message>& other, bool nonconst_need_copy) {
    *this = other;
    nonconst_need_copy_ = nonconst_need_copy;
  }
  MessageEvent(const MessageEvent<ConstMessage>& other, bool nonconst_need_copy) {
    *this = other;
    nonconst_need_copy_ = nonconst_need_copy;
  }
  MessageEvent(const MessageEvent<void const>& other, const CreateFunction& create) {
    init(boost::static_pointer_cast<ConstMessage>(other.getConstMessage()),
         other.getConnectionHeaderPtr(), other.getReceiptTime(), other.nonConstWillCopy(), create);
  }
  MessageEvent(const ConstMessagePtr& message) {
    init(message, boost::shared_ptr<M_string>(), Time::now(), true,
         DefaultMessageCreator<Message>());
  }
  MessageEvent(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& header,
               ros::Time receipt_time) {
    init(message, header, receipt_time, true, DefaultMessageCreator<Message>());
  }
  MessageEvent(const ConstMessagePtr& message, ros::Time receipt_time) {
    init(message, boost::shared_ptr<M_string>(), receipt_time, true,
         DefaultMessageCreator<Message>());
  }
  MessageEvent(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& header,
               ros::Time receipt_time, bool nonconst_need_copy, const CreateFunction& create) {
    init(message, header, receipt_time, nonconst_need_copy, create);
  }

  void init(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& header,
            ros::Time receipt_time, bool nonconst_need_copy, const CreateFunction& create) {
    message_ = message;
    message_copy_.reset();
    connection_header_ = header;
    receipt_time_ = receipt_time;
    nonconst_need_copy_ = nonconst_need_copy;
    create_ = create;
  }

  void operator=(const MessageEvent<Message>& other) { take(other); }
  void operator=(const MessageEvent<ConstMessage>& other) { take(other); }

  /// The message; a copy of it where M is not const and others have it as well.
  boost::shared_ptr<M> getMessage() const {
    if constexpr (std::is_void<Message>::value || std::is_const<M>::value) {
      return boost::const_pointer_cast<M>(message_);
    } else {
      if (!nonconst_need_copy_) return boost::const_pointer_cast<Message>(message_);
      if (!message_copy_ && message_) {
        message_copy_ = create_();
        *message_copy_ = *message_;
      }
      return message_copy_;
    }
  }
  const ConstMessagePtr& getConstMessage() const { return message_; }
  M_string& getConnectionHeader() const { return *connection_header_; }
  const boost::shared_ptr<M_string>& getConnectionHeaderPtr() const { return connection_header_; }
  const std::string& getPublisherName() const {
    static const std::string unknown("unknown_publisher");
    if (!connection_header_) return unknown;
    const M_string::const_iterator found = connection_header_->find("callerid");
    return found == connection_header_->end() ? unknown : found->second;
  }
  ros::Time getReceiptTime() const { return receipt_time_; }
  bool nonConstWillCopy() const { return nonconst_need_copy_; }
  bool getMessageWillCopy() const { return !std::is_const<M>::value && nonconst_need_copy_; }
  const CreateFunction& getMessageFactory() const { return create_; }

  bool operator<(const MessageEvent<M>& other) const {
    if (message_ != other.message_) return message_ < other.message_;
    if (receipt_time_ != other.receipt_time_) return receipt_time_ < other.receipt_time_;
    return nonconst_need_copy_ < other.nonconst_need_copy_;
  }
  bool operator==(const MessageEvent<M>& other) const {
    return message_ == other.message_ && receipt_time_ == other.receipt_time_ &&
           nonconst_need_copy_ == other.nonconst_need_copy_;
  }
  bool operator!=(const MessageEvent<M>& other) const { return !(*this == other); }

 private:
  template <typename Other>
  void take(const Other& other) {
    init(boost::static_pointer_cast<ConstMessage>(other.getConstMessage()),
         other.getConnectionHeaderPtr(), other.getReceiptTime(), other.nonConstWillCopy(),
         other.getMessageFactory());
  }

  ConstMessagePtr message_;
  mutable MessagePtr message_copy_;
  boost::shared_ptr<M_string> connection_header_;
  ros::Time receipt_time_;
  bool nonconst_need_copy_;
  CreateFunction create_;
};

}  // namespace ros
