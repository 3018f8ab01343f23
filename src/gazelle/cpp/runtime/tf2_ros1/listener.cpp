#include <algorithm>

#include "tf2_ros/static_transform_broadcaster.h"
#include "tf2_ros/transform_broadcaster.h"
#include "tf2_ros/transform_listener.h"

namespace tf2_ros {

namespace {

constexpr std::uint32_t queue_size = 100;

}  // namespace

TransformListener::TransformListener(tf2::BufferCore& buffer, bool spin_thread,
                                     ros::TransportHints transport_hints)
    : buffer_(buffer) {
  listen(spin_thread, transport_hints);
}

TransformListener::TransformListener(tf2::BufferCore& buffer, const ros::NodeHandle& nh,
                                     bool spin_thread, ros::TransportHints transport_hints)
    : buffer_(buffer), node_(nh) {
  listen(spin_thread, transport_hints);
}

void TransformListener::listen(bool spin_thread, const ros::TransportHints& hints) {
  if (spin_thread) node_.setCallbackQueue(&queue_);
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  const auto subscribe = [&](const char* topic, bool is_static) {
    boost::function<void(const Event&)> taken = [this, is_static](const Event& event) {
      take(event, is_static);
    };
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Event&>(topic, queue_size, taken);
    options.transport_hints = hints;
    return node_.subscribe(options);
  };
  moving_ = subscribe("/tf", false);
  static_ = subscribe("/tf_static", true);
  if (!spin_thread) return;
  spins_ = true;
  buffer_.setUsingDedicatedThread(true);
  thread_ = std::make_unique<std::thread>([this] {
    while (spins_) queue_.callAvailable(ros::WallDuration(0.01));
  });
}

TransformListener::~TransformListener() {
  spins_ = false;
  if (thread_) thread_->join();
  moving_.shutdown();
  static_.shutdown();
}

void TransformListener::take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event,
                             bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_update_) {
    ROS_WARN_STREAM("Detected jump back in time of " << (last_update_ - now).toSec()
                                                     << "s. Clearing TF buffer.");
    buffer_.clear();
  }
  last_update_ = now;
  const std::string authority = event.getPublisherName();
  for (const geometry_msgs::TransformStamped& one : event.getConstMessage()->transforms) {
    try {
      buffer_.setTransform(one, authority, is_static);
    } catch (const tf2::TransformException& error) {
      ROS_ERROR("Failure to set received transform from %s to %s with error: %s\n",
                one.child_frame_id.c_str(), one.header.frame_id.c_str(), error.what());
    }
  }
}

TransformBroadcaster::TransformBroadcaster()
    : publisher_(node_.advertise<tf2_msgs::TFMessage>("/tf", queue_size)) {}

void TransformBroadcaster::sendTransform(const geometry_msgs::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
}

void TransformBroadcaster::sendTransform(
    const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  publisher_.publish(message);
}

StaticTransformBroadcaster::StaticTransformBroadcaster()
    : publisher_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", queue_size, true)) {}

void StaticTransformBroadcaster::sendTransform(const geometry_msgs::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
}

void StaticTransformBroadcaster::sendTransform(
    const std::vector<geometry_msgs::TransformStamped>& transforms) {
  auto& known = net_message_.transforms;
  for (const geometry_msgs::TransformStamped& one : transforms) {
    const auto place = std::find_if(known.begin(), known.end(), [&](const auto& other) {
      return other.child_frame_id == one.child_frame_id;
    });
    if (place == known.end()) {
      known.push_back(one);
    } else {
      *place = one;
    }
  }
  publisher_.publish(net_message_);
}

}  // namespace tf2_ros
