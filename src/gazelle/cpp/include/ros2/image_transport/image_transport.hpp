// Images as messages of rclcpp: the raw transport, under image_transport's names.
#pragma once

#include <message_filters/subscriber.hpp>
#include <message_filters/time_synchronizer.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace image_transport {

class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& message) : std::runtime_error(message) {}
};

// A transport that is not there: all but raw, for now.
class TransportLoadException : public Exception {
 public:
  TransportLoadException(const std::string& transport, const std::string& message)
      : Exception("Unable to load plugin for transport '" + transport + "', error string:\n" +
                  message),
        transport_(transport) {}
  std::string getTransport() const { return transport_; }

 protected:
  std::string transport_;
};

// Which transport a subscriber wants; the node's parameter image_transport says otherwise.
class TransportHints {
 public:
  explicit TransportHints(const rclcpp::Node* node, const std::string& default_transport = "raw",
                          const std::string& parameter_name = "image_transport")
      : transport_(default_transport) {
    node->get_parameter_or<std::string>(parameter_name, transport_, default_transport);
  }
  const std::string& getTransport() const { return transport_; }

 private:
  std::string transport_;
};

// "camera_info" beside the images' topic.
inline std::string getCameraInfoTopic(const std::string& base_topic) {
  const std::size_t slash = base_topic.rfind('/');
  return (slash == std::string::npos ? std::string() : base_topic.substr(0, slash + 1)) +
         "camera_info";
}

namespace detail {

inline rclcpp::QoS qos_of(const rmw_qos_profile_t& profile) {
  return rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(profile), profile);
}
inline rmw_qos_profile_t qos_of_depth(std::uint32_t depth, bool latch = false) {
  rmw_qos_profile_t profile = rmw_qos_profile_default;
  profile.depth = depth;
  if (latch) profile.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  return profile;
}
inline void require_raw(const std::string& transport) {
  if (transport != "raw" && transport != "image_transport/raw")
    throw TransportLoadException(transport, "only the raw transport is there");
}

}  // namespace detail

class Publisher {
 public:
  using Image = sensor_msgs::msg::Image;
  Publisher() = default;
  Publisher(rclcpp::Node* node, const std::string& base_topic, rmw_qos_profile_t qos,
            rclcpp::PublisherOptions options = rclcpp::PublisherOptions())
      : publisher_(node->create_publisher<Image>(base_topic, detail::qos_of(qos), options)) {}

  std::size_t getNumSubscribers() const {
    return publisher_ ? publisher_->get_subscription_count() : 0;
  }
  std::string getTopic() const { return publisher_ ? publisher_->get_topic_name() : ""; }
  void publish(const Image& message) const {
    if (publisher_) publisher_->publish(message);
  }
  void publish(const Image::ConstSharedPtr& message) const {
    if (publisher_) publisher_->publish(*message);
  }
  void publish(Image::UniquePtr message) const {
    if (publisher_) publisher_->publish(std::move(message));
  }
  void shutdown() { publisher_.reset(); }
  operator void*() const { return publisher_.get(); }
  bool operator<(const Publisher& other) const { return publisher_ < other.publisher_; }
  bool operator!=(const Publisher& other) const { return publisher_ != other.publisher_; }
  bool operator==(const Publisher& other) const { return publisher_ == other.publisher_; }

 private:
  rclcpp::Publisher<Image>::SharedPtr publisher_;
};

class Subscriber {
 public:
  using Image = sensor_msgs::msg::Image;
  using Callback = std::function<void(const Image::ConstSharedPtr&)>;
  Subscriber() = default;
  Subscriber(rclcpp::Node* node, const std::string& base_topic, const Callback& callback,
             const std::string& transport, rmw_qos_profile_t qos = rmw_qos_profile_default,
             rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions()) {
    detail::require_raw(transport);
    subscription_ = node->create_subscription<Image>(
        base_topic, detail::qos_of(qos),
        [callback](const Image::ConstSharedPtr message) { callback(message); }, options);
  }

  std::string getTopic() const { return subscription_ ? subscription_->get_topic_name() : ""; }
  std::size_t getNumPublishers() const {
    return subscription_ ? subscription_->get_publisher_count() : 0;
  }
  std::string getTransport() const { return subscription_ ? "raw" : ""; }
  void shutdown() { subscription_.reset(); }
  operator void*() const { return subscription_.get(); }
  bool operator<(const Subscriber& other) const { return subscription_ < other.subscription_; }
  bool operator!=(const Subscriber& other) const { return subscription_ != other.subscription_; }
  bool operator==(const Subscriber& other) const { return subscription_ == other.subscription_; }

 private:
  rclcpp::Subscription<Image>::SharedPtr subscription_;
};

class CameraPublisher {
 public:
  using Image = sensor_msgs::msg::Image;
  using CameraInfo = sensor_msgs::msg::CameraInfo;
  CameraPublisher() = default;
  CameraPublisher(rclcpp::Node* node, const std::string& base_topic,
                  rmw_qos_profile_t qos = rmw_qos_profile_default)
      : image_(node, base_topic, qos),
        info_(node->create_publisher<CameraInfo>(getCameraInfoTopic(image_.getTopic()),
                                                 detail::qos_of(qos))) {}

  std::size_t getNumSubscribers() const {
    return info_ ? std::max(image_.getNumSubscribers(), info_->get_subscription_count()) : 0;
  }
  std::string getTopic() const { return image_.getTopic(); }
  std::string getInfoTopic() const { return info_ ? info_->get_topic_name() : ""; }
  void publish(const Image& image, const CameraInfo& info) const {
    if (!info_) return;
    image_.publish(image);
    info_->publish(info);
  }
  void publish(const Image::ConstSharedPtr& image, const CameraInfo::ConstSharedPtr& info) const {
    publish(*image, *info);
  }
  void publish(Image::UniquePtr image, CameraInfo::UniquePtr info) const {
    if (!info_) return;
    image_.publish(std::move(image));
    info_->publish(std::move(info));
  }
  // With a stamp for both.
  void publish(Image& image, CameraInfo& info, rclcpp::Time stamp) const {
    image.header.stamp = stamp;
    info.header.stamp = stamp;
    publish(image, info);
  }
  void shutdown() {
    image_.shutdown();
    info_.reset();
  }
  operator void*() const { return info_.get(); }

 private:
  Publisher image_;
  rclcpp::Publisher<CameraInfo>::SharedPtr info_;
};

class CameraSubscriber {
 public:
  using Image = sensor_msgs::msg::Image;
  using CameraInfo = sensor_msgs::msg::CameraInfo;
  using Callback =
      std::function<void(const Image::ConstSharedPtr&, const CameraInfo::ConstSharedPtr&)>;
  CameraSubscriber() = default;
  CameraSubscriber(rclcpp::Node* node, const std::string& base_topic, const Callback& callback,
                   const std::string& transport, rmw_qos_profile_t qos = rmw_qos_profile_default) {
    detail::require_raw(transport);
    inner_ = std::make_shared<Inner>(10);
    inner_->sync.connectInput(inner_->image, inner_->info);
    inner_->sync.registerCallback(callback);
    const std::string topic = node->get_node_topics_interface()->resolve_topic_name(base_topic);
    inner_->image.subscribe(node, topic, qos);
    inner_->info.subscribe(node, getCameraInfoTopic(topic), qos);
  }

  std::string getTopic() const { return inner_ ? inner_->image.getTopic() : ""; }
  std::string getInfoTopic() const { return inner_ ? inner_->info.getTopic() : ""; }
  std::size_t getNumPublishers() const {
    if (!inner_ || !inner_->image.getSubscriber()) return 0;
    return std::max(inner_->image.getSubscriber()->get_publisher_count(),
                    inner_->info.getSubscriber()->get_publisher_count());
  }
  std::string getTransport() const { return inner_ ? "raw" : ""; }
  void shutdown() { inner_.reset(); }
  operator void*() const { return inner_.get(); }

 private:
  struct Inner {
    explicit Inner(std::uint32_t queue_size) : sync(queue_size) {}
    message_filters::Subscriber<Image> image;
    message_filters::Subscriber<CameraInfo> info;
    message_filters::TimeSynchronizer<Image, CameraInfo> sync;
  };
  std::shared_ptr<Inner> inner_;
};

inline Publisher create_publisher(rclcpp::Node* node, const std::string& base_topic,
                                  rmw_qos_profile_t custom_qos = rmw_qos_profile_default,
                                  rclcpp::PublisherOptions options = rclcpp::PublisherOptions()) {
  return Publisher(node, base_topic, custom_qos, options);
}
inline Subscriber create_subscription(
    rclcpp::Node* node, const std::string& base_topic, const Subscriber::Callback& callback,
    const std::string& transport, rmw_qos_profile_t custom_qos = rmw_qos_profile_default,
    rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions()) {
  return Subscriber(node, base_topic, callback, transport, custom_qos, options);
}
inline CameraPublisher create_camera_publisher(
    rclcpp::Node* node, const std::string& base_topic,
    rmw_qos_profile_t custom_qos = rmw_qos_profile_default) {
  return CameraPublisher(node, base_topic, custom_qos);
}
inline CameraSubscriber create_camera_subscription(
    rclcpp::Node* node, const std::string& base_topic, const CameraSubscriber::Callback& callback,
    const std::string& transport, rmw_qos_profile_t custom_qos = rmw_qos_profile_default) {
  return CameraSubscriber(node, base_topic, callback, transport, custom_qos);
}
inline std::vector<std::string> getDeclaredTransports() { return {"image_transport/raw"}; }
inline std::vector<std::string> getLoadableTransports() { return {"image_transport/raw"}; }

// Advertises and subscribes images as in ROS 1.
class ImageTransport {
 public:
  using Image = sensor_msgs::msg::Image;
  using CameraInfo = sensor_msgs::msg::CameraInfo;
  using ImageConstPtr = Image::ConstSharedPtr;
  using CameraInfoConstPtr = CameraInfo::ConstSharedPtr;
  using VoidPtr = std::shared_ptr<void>;

  explicit ImageTransport(rclcpp::Node::SharedPtr node) : node_(std::move(node)) {}

  Publisher advertise(const std::string& base_topic, std::uint32_t queue_size, bool latch = false) {
    return advertise(base_topic, detail::qos_of_depth(queue_size, latch));
  }
  Publisher advertise(const std::string& base_topic, rmw_qos_profile_t custom_qos,
                      bool latch = false) {
    if (latch) custom_qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
    return create_publisher(node_.get(), base_topic, custom_qos);
  }
  Subscriber subscribe(const std::string& base_topic, std::uint32_t queue_size,
                       const Subscriber::Callback& callback, const VoidPtr& tracked_object = {},
                       const TransportHints* transport_hints = nullptr,
                       const rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions()) {
    return subscribe(base_topic, detail::qos_of_depth(queue_size), callback, tracked_object,
                     transport_hints, options);
  }
  Subscriber subscribe(const std::string& base_topic, rmw_qos_profile_t custom_qos,
                       const Subscriber::Callback& callback, const VoidPtr& tracked_object = {},
                       const TransportHints* transport_hints = nullptr,
                       const rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions()) {
    static_cast<void>(tracked_object);
    return create_subscription(node_.get(), base_topic, callback, transport_of(transport_hints),
                               custom_qos, options);
  }
  Subscriber subscribe(const std::string& base_topic, std::uint32_t queue_size,
                       void (*function)(const ImageConstPtr&),
                       const TransportHints* transport_hints = nullptr) {
    return subscribe(base_topic, queue_size, Subscriber::Callback(function), VoidPtr(),
                     transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, std::uint32_t queue_size,
                       void (T::*method)(const ImageConstPtr&), T* object,
                       const TransportHints* transport_hints = nullptr) {
    return subscribe(
        base_topic, queue_size,
        Subscriber::Callback([method, object](const ImageConstPtr& m) { (object->*method)(m); }),
        VoidPtr(), transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, std::uint32_t queue_size,
                       void (T::*method)(const ImageConstPtr&), const std::shared_ptr<T>& object,
                       const TransportHints* transport_hints = nullptr) {
    return subscribe(base_topic, queue_size,
                     Subscriber::Callback(
                         [method, object](const ImageConstPtr& m) { (object.get()->*method)(m); }),
                     object, transport_hints);
  }
  CameraPublisher advertiseCamera(const std::string& base_topic, std::uint32_t queue_size,
                                  bool latch = false) {
    return create_camera_publisher(node_.get(), base_topic,
                                   detail::qos_of_depth(queue_size, latch));
  }
  CameraSubscriber subscribeCamera(const std::string& base_topic, std::uint32_t queue_size,
                                   const CameraSubscriber::Callback& callback,
                                   const VoidPtr& tracked_object = {},
                                   const TransportHints* transport_hints = nullptr) {
    static_cast<void>(tracked_object);
    return create_camera_subscription(node_.get(), base_topic, callback,
                                      transport_of(transport_hints),
                                      detail::qos_of_depth(queue_size));
  }
  template <class T>
  CameraSubscriber subscribeCamera(const std::string& base_topic, std::uint32_t queue_size,
                                   void (T::*method)(const ImageConstPtr&,
                                                     const CameraInfoConstPtr&),
                                   T* object, const TransportHints* transport_hints = nullptr) {
    return subscribeCamera(
        base_topic, queue_size,
        CameraSubscriber::Callback(
            [method, object](const ImageConstPtr& image, const CameraInfoConstPtr& info) {
              (object->*method)(image, info);
            }),
        VoidPtr(), transport_hints);
  }
  std::vector<std::string> getDeclaredTransports() const {
    return image_transport::getDeclaredTransports();
  }
  std::vector<std::string> getLoadableTransports() const {
    return image_transport::getLoadableTransports();
  }

 private:
  std::string transport_of(const TransportHints* hints) const {
    return hints ? hints->getTransport() : TransportHints(node_.get()).getTransport();
  }
  rclcpp::Node::SharedPtr node_;
};

// Images as a filter of message_filters.
class SubscriberFilter : public message_filters::SimpleFilter<sensor_msgs::msg::Image> {
 public:
  SubscriberFilter() = default;
  SubscriberFilter(rclcpp::Node* node, const std::string& base_topic,
                   const std::string& transport) {
    subscribe(node, base_topic, transport);
  }
  void subscribe(rclcpp::Node* node, const std::string& base_topic, const std::string& transport,
                 rmw_qos_profile_t custom_qos = rmw_qos_profile_default,
                 rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions()) {
    unsubscribe();
    subscriber_ = create_subscription(
        node, base_topic,
        [this](const sensor_msgs::msg::Image::ConstSharedPtr& image) { signalMessage(image); },
        transport, custom_qos, options);
  }
  void unsubscribe() { subscriber_.shutdown(); }
  std::string getTopic() const { return subscriber_.getTopic(); }
  std::size_t getNumPublishers() const { return subscriber_.getNumPublishers(); }
  std::string getTransport() const { return subscriber_.getTransport(); }
  const Subscriber& getSubscriber() const { return subscriber_; }

 private:
  Subscriber subscriber_;
};

}  // namespace image_transport
