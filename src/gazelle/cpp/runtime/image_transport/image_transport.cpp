// Images by transports: raw here, others as plugins.

#include <image_transport/image_transport.h>
#include <image_transport/raw_publisher.h>
#include <image_transport/raw_subscriber.h>
#include <image_transport/subscriber_filter.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <pluginlib/class_loader.h>
#include <ros/console.h>

#include <algorithm>
#include <memory>
#include <mutex>

namespace image_transport {

namespace {

const char kPackage[] = "image_transport";
const char kRaw[] = "image_transport/raw";  // ours, also where the original's sources are

// The plugins of one side; packages without any cost one look.
template <class Plugin>
pluginlib::ClassLoader<Plugin>& plugins(const char* base_class) {
  static auto* const loader = new pluginlib::ClassLoader<Plugin>(kPackage, base_class);
  return *loader;
}
pluginlib::ClassLoader<PublisherPlugin>& publisherPlugins() {
  return plugins<PublisherPlugin>("image_transport::PublisherPlugin");
}
pluginlib::ClassLoader<SubscriberPlugin>& subscriberPlugins() {
  return plugins<SubscriberPlugin>("image_transport::SubscriberPlugin");
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// "image_transport/resized_pub" as "image_transport/resized".
std::string transportOf(const std::string& lookup_name) {
  return lookup_name.substr(0, lookup_name.size() - 4);
}

bool isDisabled(const std::vector<std::string>& names, const std::string& transport) {
  return std::find(names.begin(), names.end(), transport) != names.end();
}

}  // namespace

std::string getCameraInfoTopic(const std::string& base_topic) {
  const std::string clean = ros::names::clean(base_topic);
  const std::size_t slash = clean.rfind('/');
  return (slash == std::string::npos ? std::string() : clean.substr(0, slash + 1)) + "camera_info";
}

// ---- Publisher

struct Publisher::Impl {
  ~Impl() { shutdown(); }
  void shutdown() {
    if (is_closed) return;
    is_closed = true;
    for (const auto& one : publishers) one->shutdown();
  }
  std::string base_topic;
  bool is_closed = false;
  std::vector<boost::shared_ptr<PublisherPlugin> > publishers;
};

bool Publisher::isValid() const { return impl_ && !impl_->is_closed; }
uint32_t Publisher::getNumSubscribers() const {
  uint32_t count = 0;
  if (isValid())
    for (const auto& one : impl_->publishers) count += one->getNumSubscribers();
  return count;
}
std::string Publisher::getTopic() const { return impl_ ? impl_->base_topic : std::string(); }
void Publisher::publish(const sensor_msgs::Image& message) const {
  if (!isValid()) {
    if (ros::ok()) ROS_ERROR("Call to publish() on an invalid image_transport::Publisher");
    return;
  }
  // The raw one looks itself whether anybody listens.
  for (const auto& one : impl_->publishers)
    if (one == impl_->publishers.front() || one->getNumSubscribers() > 0) one->publish(message);
}
void Publisher::publish(const sensor_msgs::ImageConstPtr& message) const {
  if (!isValid()) {
    if (ros::ok()) ROS_ERROR("Call to publish() on an invalid image_transport::Publisher");
    return;
  }
  for (const auto& one : impl_->publishers)
    if (one == impl_->publishers.front() || one->getNumSubscribers() > 0) one->publish(message);
}
void Publisher::shutdown() {
  if (impl_) impl_->shutdown();
  impl_.reset();
}

Publisher ImageTransport::advertise(const std::string& base_topic, uint32_t queue_size,
                                    const SubscriberStatusCallback& connect_cb,
                                    const SubscriberStatusCallback& disconnect_cb,
                                    const ros::VoidPtr& tracked_object, bool latch) {
  Publisher publisher;
  publisher.impl_ = boost::make_shared<Publisher::Impl>();
  Publisher::Impl& impl = *publisher.impl_;
  impl.base_topic = nh_.resolveName(base_topic);
  std::vector<std::string> disabled;
  nh_.getParam(impl.base_topic + "/disable_pub_plugins", disabled);

  std::vector<boost::shared_ptr<PublisherPlugin> > all;
  all.push_back(boost::make_shared<RawPublisher>());
  for (const std::string& name : publisherPlugins().getDeclaredClasses()) {
    if (!endsWith(name, "_pub") || transportOf(name) == kRaw ||
        isDisabled(disabled, transportOf(name)))
      continue;
    try {
      all.push_back(publisherPlugins().createInstance(name));
    } catch (const std::exception& error) {
      ROS_DEBUG("Failed to load plugin %s, error string: %s", name.c_str(), error.what());
    }
  }
  for (const auto& one : all) {
    one->advertise(nh_, impl.base_topic, queue_size, connect_cb, disconnect_cb, tracked_object,
                   latch);
    impl.publishers.push_back(one);
  }
  return publisher;
}

// ---- Subscriber

struct Subscriber::Impl {
  ~Impl() { shutdown(); }
  void shutdown() {
    if (is_closed) return;
    is_closed = true;
    if (subscriber) subscriber->shutdown();
  }
  bool is_closed = false;
  boost::shared_ptr<SubscriberPlugin> subscriber;
};

bool Subscriber::isValid() const { return impl_ && !impl_->is_closed; }
std::string Subscriber::getTopic() const {
  return isValid() ? impl_->subscriber->getTopic() : std::string();
}
uint32_t Subscriber::getNumPublishers() const {
  return isValid() ? impl_->subscriber->getNumPublishers() : 0;
}
std::string Subscriber::getTransport() const {
  return isValid() ? impl_->subscriber->getTransportName() : std::string();
}
void Subscriber::shutdown() {
  if (impl_) impl_->shutdown();
  impl_.reset();
}

Subscriber ImageTransport::subscribe(const std::string& base_topic, uint32_t queue_size,
                                     const ImageCallback& callback,
                                     const ros::VoidPtr& tracked_object,
                                     const TransportHints& transport_hints) {
  Subscriber subscriber;
  subscriber.impl_ = boost::make_shared<Subscriber::Impl>();
  const std::string& transport = transport_hints.getTransport();
  if (transport == "raw" || transport == kRaw) {
    subscriber.impl_->subscriber = boost::make_shared<RawSubscriber>();
  } else {
    std::string name = SubscriberPlugin::getLookupName(transport);
    // Plugins of users have their own package in front.
    for (const std::string& known : subscriberPlugins().getDeclaredClasses())
      if (known == transport + "_sub" || endsWith(known, "/" + transport + "_sub")) name = known;
    try {
      subscriber.impl_->subscriber = subscriberPlugins().createInstance(name);
    } catch (const std::exception& error) {
      throw TransportLoadException(transport, error.what());
    }
  }
  // A transport's own topic is easily taken for the base.
  const std::string clean = ros::names::clean(base_topic);
  const std::size_t slash = clean.rfind('/');
  if (slash != std::string::npos && transport != "raw" && clean.substr(slash + 1) == transport)
    ROS_WARN(
        "[image_transport] It looks like you are trying to subscribe directly to a "
        "transport-specific image topic '%s', in which case you will likely get a connection "
        "error. Try subscribing to the base topic '%s' instead with parameter "
        "~image_transport set to '%s' (on the command line, _image_transport:=%s).",
        clean.c_str(), clean.substr(0, slash).c_str(), transport.c_str(), transport.c_str());
  subscriber.impl_->subscriber->subscribe(nh_, base_topic, queue_size, callback, tracked_object,
                                          transport_hints);
  return subscriber;
}

// ---- Cameras

struct CameraPublisher::Impl {
  Publisher image;
  ros::Publisher info;
  bool is_closed = false;
};

bool CameraPublisher::isValid() const { return impl_ && !impl_->is_closed; }
uint32_t CameraPublisher::getNumSubscribers() const {
  return isValid() ? std::max(impl_->image.getNumSubscribers(), impl_->info.getNumSubscribers())
                   : 0;
}
std::string CameraPublisher::getTopic() const {
  return impl_ ? impl_->image.getTopic() : std::string();
}
std::string CameraPublisher::getInfoTopic() const {
  return impl_ ? impl_->info.getTopic() : std::string();
}
void CameraPublisher::publish(const sensor_msgs::Image& image,
                              const sensor_msgs::CameraInfo& info) const {
  if (!isValid()) {
    if (ros::ok()) ROS_ERROR("Call to publish() on an invalid image_transport::CameraPublisher");
    return;
  }
  impl_->image.publish(image);
  impl_->info.publish(info);
}
void CameraPublisher::publish(const sensor_msgs::ImageConstPtr& image,
                              const sensor_msgs::CameraInfoConstPtr& info) const {
  if (!isValid()) {
    if (ros::ok()) ROS_ERROR("Call to publish() on an invalid image_transport::CameraPublisher");
    return;
  }
  impl_->image.publish(image);
  impl_->info.publish(info);
}
void CameraPublisher::publish(sensor_msgs::Image& image, sensor_msgs::CameraInfo& info,
                              ros::Time stamp) const {
  image.header.stamp = stamp;
  info.header.stamp = stamp;
  publish(image, info);
}
void CameraPublisher::shutdown() {
  if (!impl_) return;
  impl_->is_closed = true;
  impl_->image.shutdown();
  impl_->info.shutdown();
  impl_.reset();
}

CameraPublisher ImageTransport::advertiseCamera(
    const std::string& base_topic, uint32_t queue_size,
    const SubscriberStatusCallback& image_connect_cb,
    const SubscriberStatusCallback& image_disconnect_cb,
    const ros::SubscriberStatusCallback& info_connect_cb,
    const ros::SubscriberStatusCallback& info_disconnect_cb, const ros::VoidPtr& tracked_object,
    bool latch) {
  CameraPublisher publisher;
  publisher.impl_ = boost::make_shared<CameraPublisher::Impl>();
  // Beside the images' own topic, where remappings have moved it.
  const std::string image_topic = nh_.resolveName(base_topic);
  publisher.impl_->image = advertise(image_topic, queue_size, image_connect_cb, image_disconnect_cb,
                                     tracked_object, latch);
  publisher.impl_->info = nh_.advertise<sensor_msgs::CameraInfo>(
      getCameraInfoTopic(image_topic), queue_size, info_connect_cb, info_disconnect_cb,
      tracked_object, latch);
  return publisher;
}

struct CameraSubscriber::Impl {
  explicit Impl(uint32_t queue_size) : sync(queue_size) {}
  void shutdown() {
    if (is_closed) return;
    is_closed = true;
    image.unsubscribe();
    info.unsubscribe();
  }
  ~Impl() { shutdown(); }
  SubscriberFilter image;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> sync;
  std::mutex mutex;
  ros::WallTimer check;
  int images = 0, infos = 0, both = 0;
  bool is_closed = false;

  // Images and infos that never meet are told: their stamps differ.
  void look() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (3 * both < std::min(images, infos))
      ROS_WARN(
          "[image_transport] Topics '%s' and '%s' do not appear to be synchronized. In the "
          "last 10s:\n\tImage messages received:      %d\n\tCameraInfo messages received: "
          "%d\n\tSynchronized pairs:           %d",
          image.getTopic().c_str(), info.getTopic().c_str(), images, infos, both);
    images = infos = both = 0;
  }
};

bool CameraSubscriber::isValid() const { return impl_ && !impl_->is_closed; }
std::string CameraSubscriber::getTopic() const {
  return isValid() ? impl_->image.getTopic() : std::string();
}
std::string CameraSubscriber::getInfoTopic() const {
  return isValid() ? impl_->info.getSubscriber().getTopic() : std::string();
}
uint32_t CameraSubscriber::getNumPublishers() const {
  return isValid() ? std::max(impl_->image.getNumPublishers(),
                              impl_->info.getSubscriber().getNumPublishers())
                   : 0;
}
std::string CameraSubscriber::getTransport() const {
  return isValid() ? impl_->image.getTransport() : std::string();
}
void CameraSubscriber::shutdown() {
  if (impl_) impl_->shutdown();
  impl_.reset();
}

CameraSubscriber ImageTransport::subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                                 const CameraSubscriber::Callback& callback,
                                                 const ros::VoidPtr& tracked_object,
                                                 const TransportHints& transport_hints) {
  typedef CameraSubscriber::Impl Impl;
  CameraSubscriber subscriber;
  subscriber.impl_ = boost::make_shared<Impl>(queue_size);
  Impl* const impl = subscriber.impl_.get();
  const std::string image_topic = nh_.resolveName(base_topic);
  impl->image.registerCallback([impl](const sensor_msgs::ImageConstPtr&) {
    const std::lock_guard<std::mutex> lock(impl->mutex);
    ++impl->images;
  });
  impl->info.registerCallback([impl](const sensor_msgs::CameraInfoConstPtr&) {
    const std::lock_guard<std::mutex> lock(impl->mutex);
    ++impl->infos;
  });
  impl->sync.connectInput(impl->image, impl->info);
  const bool is_tracked = static_cast<bool>(tracked_object);
  const boost::weak_ptr<void> tracked = tracked_object;
  impl->sync.registerCallback(
      [impl, callback, is_tracked, tracked](const sensor_msgs::ImageConstPtr& image,
                                            const sensor_msgs::CameraInfoConstPtr& info) {
        {
          const std::lock_guard<std::mutex> lock(impl->mutex);
          ++impl->both;
        }
        const ros::VoidPtr held = tracked.lock();
        if (!is_tracked || held) callback(image, info);
      });
  impl->image.subscribe(*this, image_topic, queue_size, transport_hints);
  impl->info.subscribe(nh_, getCameraInfoTopic(image_topic), queue_size,
                       transport_hints.getRosHints());
  impl->check = nh_.createWallTimer(
      ros::WallDuration(10.0),
      ros::WallTimerCallback([impl](const ros::WallTimerEvent&) { impl->look(); }));
  return subscriber;
}

// ---- What there is

std::vector<std::string> ImageTransport::getDeclaredTransports() const {
  std::vector<std::string> found{kRaw};
  for (const std::string& name : subscriberPlugins().getDeclaredClasses())
    if (endsWith(name, "_sub") && transportOf(name) != kRaw) found.push_back(transportOf(name));
  return found;
}

std::vector<std::string> ImageTransport::getLoadableTransports() const {
  std::vector<std::string> found{kRaw};
  for (const std::string& name : subscriberPlugins().getDeclaredClasses()) {
    try {
      if (endsWith(name, "_sub") && transportOf(name) != kRaw &&
          subscriberPlugins().createInstance(name))
        found.push_back(transportOf(name));
    } catch (const std::exception& error) {
      ROS_DEBUG("Transport %s cannot be loaded: %s", name.c_str(), error.what());
    }
  }
  return found;
}

}  // namespace image_transport
