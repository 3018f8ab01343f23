#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/subscription_callback_helper.h>
#include <gazelle/core.hpp>
#include <gazelle/pointers.hpp>

#include <boost/shared_ptr.hpp>

#include <type_traits>

namespace ros {

/// One end of a topic; the topic is left when the last copy goes.
class ROSCPP_DECL Publisher {
 public:
  Publisher() {}

  /// Publishes an object that nobody changes afterwards: subscribers of this process get it
  /// itself.
  template <typename M>
  void publish(const boost::shared_ptr<M>& message) const {
    typedef typename std::remove_const<M>::type Message;
    if (!message) return;
    if constexpr (detail::IsDescribed<Message>::value) {
      if (!accepts(gazelle::message_type<Message>())) return;
      send(gazelle::to_std(boost::shared_ptr<const void>(message)),
           gazelle::message_type<Message>());
    } else {
      publish(*message);
    }
  }

  /// Publishes what the object holds now.
  template <typename M>
  void publish(const M& message) const {
    if constexpr (detail::IsDescribed<M>::value) {
      if (!accepts(gazelle::message_type<M>())) return;
      sendCopy(&message, gazelle::message_type<M>(), &detail::copyOf<M>);
    } else if constexpr (std::is_same<M, SerializedMessage>::value) {
      sendRos1(message.message_start,
               message.num_bytes - (message.message_start - message.buf.get()));
    } else {
      std::vector<uint8_t> bytes(serialization::serializationLength(message));
      serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
      serialization::serialize(stream, message);
      sendRos1(bytes.data(), bytes.size());
    }
  }

  void shutdown();
  std::string getTopic() const;
  uint32_t getNumSubscribers() const;
  bool isLatched() const;

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const Publisher& other) const { return impl_ < other.impl_; }
  bool operator==(const Publisher& other) const { return impl_ == other.impl_; }
  bool operator!=(const Publisher& other) const { return impl_ != other.impl_; }

  class Impl;

 private:
  friend class NodeHandle;
  friend class SingleSubscriberPublisher;
  explicit Publisher(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}

  bool isValid() const;
  /// False, and says so, where it was advertised with another type or not at all.
  bool accepts(const gazelle::MessageType& type) const;
  void send(std::shared_ptr<const void> message, const gazelle::MessageType& type) const;
  void sendCopy(const void* message, const gazelle::MessageType& type,
                std::shared_ptr<const void> (*copy)(const void*)) const;
  void sendRos1(const uint8_t* bytes, std::size_t size) const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<Publisher> V_Publisher;

}  // namespace ros
