#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/subscription_callback_helper.h>

namespace ros {

/// All that a publisher may be told.
struct ROSCPP_DECL AdvertiseOptions {
  AdvertiseOptions() : callback_queue(0), latch(false), has_header(false) {}
  AdvertiseOptions(const std::string& topic_, uint32_t queue_size_, const std::string& md5sum_,
                   const std::string& datatype_, const std::string& message_definition_,
                   const SubscriberStatusCallback& connect = SubscriberStatusCallback(),
                   const SubscriberStatusCallback& disconnect = SubscriberStatusCallback())
      : topic(topic_),
        queue_size(queue_size_),
        md5sum(md5sum_),
        datatype(datatype_),
        message_definition(message_definition_),
        connect_cb(connect),
        disconnect_cb(disconnect),
        callback_queue(0),
        latch(false),
        has_header(false) {}

  template <class M>
  void init(const std::string& topic_, uint32_t queue_size_,
            const SubscriberStatusCallback& connect = SubscriberStatusCallback(),
            const SubscriberStatusCallback& disconnect = SubscriberStatusCallback()) {
    topic = topic_;
    queue_size = queue_size_;
    connect_cb = connect;
    disconnect_cb = disconnect;
    md5sum = message_traits::md5sum<M>();
    datatype = message_traits::datatype<M>();
    message_definition = message_traits::definition<M>();
    has_header = message_traits::hasHeader<M>();
    type = detail::messageTypeOf<M>();
  }

  template <class M>
  static AdvertiseOptions create(const std::string& topic, uint32_t queue_size,
                                 const SubscriberStatusCallback& connect,
                                 const SubscriberStatusCallback& disconnect,
                                 const VoidConstPtr& tracked_object,
                                 CallbackQueueInterface* queue) {
    AdvertiseOptions options;
    options.init<M>(topic, queue_size, connect, disconnect);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string topic;
  uint32_t queue_size = 1;
  std::string md5sum;
  std::string datatype;
  std::string message_definition;
  SubscriberStatusCallback connect_cb;
  SubscriberStatusCallback disconnect_cb;
  CallbackQueueInterface* callback_queue;
  VoidConstPtr tracked_object;
  bool latch;
  bool has_header;
  const gazelle::MessageType* type = 0;  ///< Gazelle's: the class, where it is known
};

}  // namespace ros
