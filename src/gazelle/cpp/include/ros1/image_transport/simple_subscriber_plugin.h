#pragma once

#include <image_transport/subscriber_plugin.h>

#include <boost/scoped_ptr.hpp>

namespace image_transport {

/// A transport with one message for each image, on <base topic>/<transport>.
template <class M>
class SimpleSubscriberPlugin : public SubscriberPlugin {
 public:
  virtual ~SimpleSubscriberPlugin() {}
  virtual std::string getTopic() const {
    return inner_ ? inner_->subscriber.getTopic() : std::string();
  }
  virtual uint32_t getNumPublishers() const {
    return inner_ ? inner_->subscriber.getNumPublishers() : 0;
  }
  virtual void shutdown() {
    if (inner_) inner_->subscriber.shutdown();
  }

 protected:
  /// The transport's own: makes the image of a message and gives it to the user.
  virtual void internalCallback(const typename M::ConstPtr& message, const Callback& user_cb) = 0;
  virtual std::string getTopicToSubscribe(const std::string& base_topic) const {
    return base_topic + "/" + getTransportName();
  }
  virtual void subscribeImpl(ros::NodeHandle& nh, const std::string& base_topic,
                             uint32_t queue_size, const Callback& callback,
                             const ros::VoidPtr& tracked_object,
                             const TransportHints& transport_hints) {
    inner_.reset(new Inner(ros::NodeHandle(transport_hints.getParameterNH(), getTransportName())));
    inner_->subscriber = nh.subscribe<M>(getTopicToSubscribe(base_topic), queue_size,
                                         boost::function<void(const typename M::ConstPtr&)>(
                                             [this, callback](const typename M::ConstPtr& message) {
                                               internalCallback(message, callback);
                                             }),
                                         tracked_object, transport_hints.getRosHints());
  }
  const ros::NodeHandle& nh() const { return inner_->param_nh; }

 private:
  struct Inner {
    Inner(const ros::NodeHandle& nh) : param_nh(nh) {}
    const ros::NodeHandle param_nh;
    ros::Subscriber subscriber;
  };
  boost::scoped_ptr<Inner> inner_;
};

}  // namespace image_transport
