#pragma once

#include <image_transport/publisher_plugin.h>

#include <boost/scoped_ptr.hpp>

namespace image_transport {

/// A transport that publishes one message for each image, on <base topic>/<transport>.
template <class M>
class SimplePublisherPlugin : public PublisherPlugin {
 public:
  virtual ~SimplePublisherPlugin() {}
  virtual uint32_t getNumSubscribers() const {
    return inner_ ? inner_->publisher.getNumSubscribers() : 0;
  }
  virtual std::string getTopic() const {
    return inner_ ? inner_->publisher.getTopic() : std::string();
  }
  using PublisherPlugin::publish;
  virtual void publish(const sensor_msgs::Image& message) const {
    if (!inner_ || !inner_->publisher) {
      ROS_ERROR("Call to publish() on an invalid image_transport::SimplePublisherPlugin");
      return;
    }
    publish(message, through(inner_->publisher));
  }
  virtual void shutdown() {
    if (inner_) inner_->publisher.shutdown();
  }

 protected:
  typedef boost::function<void(const M&)> PublishFn;

  /// The transport's own: makes the message of an image and gives it to the function.
  virtual void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const = 0;
  virtual std::string getTopicToAdvertise(const std::string& base_topic) const {
    return base_topic + "/" + getTransportName();
  }
  virtual void connectCallback(const ros::SingleSubscriberPublisher&) {}
  virtual void disconnectCallback(const ros::SingleSubscriberPublisher&) {}

  virtual void advertiseImpl(ros::NodeHandle& nh, const std::string& base_topic,
                             uint32_t queue_size, const SubscriberStatusCallback& user_connect_cb,
                             const SubscriberStatusCallback& user_disconnect_cb,
                             const ros::VoidPtr& tracked_object, bool latch) {
    const std::string topic = getTopicToAdvertise(base_topic);
    inner_.reset(new Inner(ros::NodeHandle(topic)));
    inner_->publisher = nh.advertise<M>(
        topic, queue_size,
        told(user_connect_cb,
             [this](const ros::SingleSubscriberPublisher& one) { connectCallback(one); }),
        told(user_disconnect_cb,
             [this](const ros::SingleSubscriberPublisher& one) { disconnectCallback(one); }),
        tracked_object, latch);
  }
  const ros::NodeHandle& nh() const { return inner_->param_nh; }
  const ros::Publisher& getPublisher() const { return inner_->publisher; }

 private:
  struct Inner {
    Inner(const ros::NodeHandle& nh) : param_nh(nh) {}
    const ros::NodeHandle param_nh;
    ros::Publisher publisher;
  };

  template <class P>
  PublishFn through(const P& publisher) const {
    return [&publisher](const M& message) { publisher.publish(message); };
  }
  ros::SubscriberStatusCallback told(
      const SubscriberStatusCallback& user,
      const boost::function<void(const ros::SingleSubscriberPublisher&)>& own) {
    if (!user) return own;
    return [this, user, own](const ros::SingleSubscriberPublisher& one) {
      own(one);
      user(SingleSubscriberPublisher(
          one.getSubscriberName(), getTopic(), [this] { return getNumSubscribers(); },
          [this, one](const sensor_msgs::Image& image) { publish(image, through(one)); }));
    };
  }

  boost::scoped_ptr<Inner> inner_;
};

}  // namespace image_transport
