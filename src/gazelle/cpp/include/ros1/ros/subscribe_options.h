#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/subscription_callback_helper.h>
#include <ros/transport_hints.h>

namespace ros {

/// All that a subscription may be told.
struct ROSCPP_DECL SubscribeOptions {
  SubscribeOptions() : queue_size(1), callback_queue(0), allow_concurrent_callbacks(false) {}
  SubscribeOptions(const std::string& topic_, uint32_t queue_size_, const std::string& md5sum_,
                   const std::string& datatype_)
      : topic(topic_),
        queue_size(queue_size_),
        md5sum(md5sum_),
        datatype(datatype_),
        callback_queue(0),
        allow_concurrent_callbacks(false) {}

  template <class P>
  void initByFullCallbackType(
      const std::string& topic_, uint32_t queue_size_, const boost::function<void(P)>& callback,
      const boost::function<boost::shared_ptr<typename ParameterAdapter<P>::Message>(void)>&
          factory = DefaultMessageCreator<typename ParameterAdapter<P>::Message>()) {
    typedef typename ParameterAdapter<P>::Message Message;
    topic = topic_;
    queue_size = queue_size_;
    md5sum = message_traits::md5sum<Message>();
    datatype = message_traits::datatype<Message>();
    helper = boost::make_shared<SubscriptionCallbackHelperT<P> >(callback, factory);
  }

  template <class M>
  void init(
      const std::string& topic_, uint32_t queue_size_,
      const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
      const boost::function<boost::shared_ptr<M>(void)>& factory = DefaultMessageCreator<M>()) {
    typedef typename ParameterAdapter<M>::Message Message;
    topic = topic_;
    queue_size = queue_size_;
    md5sum = message_traits::md5sum<Message>();
    datatype = message_traits::datatype<Message>();
    helper =
        boost::make_shared<SubscriptionCallbackHelperT<const boost::shared_ptr<Message const>&> >(
            callback, factory);
  }

  template <class M>
  static SubscribeOptions create(
      const std::string& topic, uint32_t queue_size,
      const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
      const VoidConstPtr& tracked_object, CallbackQueueInterface* queue) {
    SubscribeOptions options;
    options.init<M>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string topic;
  uint32_t queue_size;
  std::string md5sum;
  std::string datatype;
  SubscriptionCallbackHelperPtr helper;
  CallbackQueueInterface* callback_queue;
  bool allow_concurrent_callbacks;
  VoidConstPtr tracked_object;
  TransportHints transport_hints;
};

}  // namespace ros
