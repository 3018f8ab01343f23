#include "tf2_ros/buffer.h"

#include "tf2_msgs/FrameGraph.h"

namespace tf2_ros {

namespace {

constexpr std::int64_t look_again_ns = 10000000;

// Until it can be had, time is up, time jumps far back, or the node ends.
template <class Can>
bool wait_until(const tf2::BufferCore& buffer, const ros::Duration& timeout, std::string* why,
                Can can) {
  if (timeout > ros::Duration(0.0) && !buffer.isUsingDedicatedThread()) {
    if (why != nullptr) *why = threading_error;
    ROS_ERROR("%s", threading_error.c_str());
    return false;
  }
  const ros::Time start = ros::Time::now();
  ros::Time now = start;
  while (now < start + timeout && !can(nullptr) && now + ros::Duration(3.0) >= start && ros::ok()) {
    buffer.gazelle_tree().wait_for_change(look_again_ns);
    now = ros::Time::now();
  }
  const bool is_there = can(why);
  if (!is_there && why != nullptr && timeout > ros::Duration(0.0)) {
    std::ostringstream text;
    text << ". canTransform returned after " << (ros::Time::now() - start).toSec()
         << " timeout was " << timeout.toSec() << ".";
    *why += text.str();
  }
  return is_there;
}

}  // namespace

Buffer::Buffer(ros::Duration cache_time, bool debug) : BufferCore(cache_time) {
  if (!debug || ros::service::exists("~tf2_frames", false)) return;
  ros::NodeHandle node("~");
  using Request = tf2_msgs::FrameGraph::Request;
  using Response = tf2_msgs::FrameGraph::Response;
  boost::function<bool(Request&, Response&)> tell = [this](Request&, Response& response) {
    response.frame_yaml = allFramesAsYAML();
    return true;
  };
  frames_server_ = node.advertiseService<Request, Response>("tf2_frames", tell);
}

geometry_msgs::TransformStamped Buffer::lookupTransform(const std::string& target_frame,
                                                        const std::string& source_frame,
                                                        const ros::Time& time,
                                                        const ros::Duration timeout) const {
  canTransform(target_frame, source_frame, time, timeout);
  return lookupTransform(target_frame, source_frame, time);
}

geometry_msgs::TransformStamped Buffer::lookupTransform(const std::string& target_frame,
                                                        const ros::Time& target_time,
                                                        const std::string& source_frame,
                                                        const ros::Time& source_time,
                                                        const std::string& fixed_frame,
                                                        const ros::Duration timeout) const {
  canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, timeout);
  return lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame);
}

bool Buffer::canTransform(const std::string& target_frame, const std::string& source_frame,
                          const ros::Time& target_time, const ros::Duration timeout,
                          std::string* errstr) const {
  return wait_until(*this, timeout, errstr, [&](std::string* why) {
    return canTransform(target_frame, source_frame, target_time, why);
  });
}

bool Buffer::canTransform(const std::string& target_frame, const ros::Time& target_time,
                          const std::string& source_frame, const ros::Time& source_time,
                          const std::string& fixed_frame, const ros::Duration timeout,
                          std::string* errstr) const {
  return wait_until(*this, timeout, errstr, [&](std::string* why) {
    return canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, why);
  });
}

}  // namespace tf2_ros
