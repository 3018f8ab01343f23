// A node of ROS 2 that sends frames by tf2, hears of others, and holds points back.
#include <cstdio>

#include "geometry_msgs/msg/point_stamped.hpp"
#include "message_filters/subscriber.h"
#include "rclcpp/rclcpp.hpp"
#include "tf2/utils.h"
#include "tf2_geometry_msgs/tf2_geometry_msgs.hpp"
#include "tf2_ros/buffer.h"
#include "tf2_ros/create_timer_ros.h"
#include "tf2_ros/message_filter.h"
#include "tf2_ros/static_transform_broadcaster.h"
#include "tf2_ros/transform_broadcaster.h"
#include "tf2_ros/transform_listener.h"

using geometry_msgs::msg::PointStamped;
using namespace std::chrono_literals;

namespace {

void said(const char* what, double x, double y, double z) {
  std::printf("%s %.3f %.3f %.3f\n", what, x, y, z);
  std::fflush(stdout);
}

class Frames : public rclcpp::Node {
 public:
  Frames() : Node("frames"), still_(this), moving_(this) {
    buffer_ = std::make_shared<tf2_ros::Buffer>(get_clock());
    buffer_->setCreateTimerInterface(std::make_shared<tf2_ros::CreateTimerROS>(
        get_node_base_interface(), get_node_timers_interface()));
    listener_ = std::make_shared<tf2_ros::TransformListener>(*buffer_);

    geometry_msgs::msg::TransformStamped mount;
    mount.header.frame_id = "base_link";
    mount.transform.translation.z = 0.5;
    for (const char* child : {"camera", "laser"}) {
      mount.child_frame_id = child;
      still_.sendTransform(mount);
    }
    timer_ = create_wall_timer(20ms, [this] {
      geometry_msgs::msg::TransformStamped pose;
      pose.header.stamp = now();
      pose.header.frame_id = "odom";
      pose.child_frame_id = "base_link";
      tf2::Quaternion turn;
      turn.setRPY(0, 0, M_PI / 2);
      pose.transform = tf2::toMsg(tf2::Transform(turn, tf2::Vector3(1.0, 2.0, 0.0)));
      moving_.sendTransform(pose);
    });
    points_.subscribe(this, "points");
    filter_ = std::make_shared<tf2_ros::MessageFilter<PointStamped>>(
        points_, *buffer_, "odom", 10, get_node_logging_interface(), get_node_clock_interface(),
        3s);
    filter_->registerCallback(&Frames::placed, this);
    buffer_->waitForTransform("odom", "gripper", tf2::TimePointZero, 20s,
                              [this](const tf2_ros::TransformStampedFuture& answer) {
                                const auto t = answer.get().transform.translation;
                                said("gripper", t.x, t.y, t.z);
                                tell_errors();
                              });
  }

 private:
  void placed(const PointStamped::ConstSharedPtr& point) {
    const PointStamped out = buffer_->transform(*point, "odom");
    said("filtered", out.point.x, out.point.y, out.point.z);
  }
  void tell_errors() {
    try {
      buffer_->lookupTransform("odom", "nowhere", tf2::TimePointZero);
    } catch (const tf2::LookupException& error) {
      std::printf("error %s\n", error.what());
    }
    std::string why;
    buffer_->canTransform("odom", "nowhere", tf2::TimePointZero, 10ms, &why);
    std::printf("why %s\n", why.c_str());
    std::fflush(stdout);
  }

  std::shared_ptr<tf2_ros::Buffer> buffer_;
  std::shared_ptr<tf2_ros::TransformListener> listener_;
  tf2_ros::StaticTransformBroadcaster still_;
  tf2_ros::TransformBroadcaster moving_;
  rclcpp::TimerBase::SharedPtr timer_;
  message_filters::Subscriber<PointStamped> points_;
  std::shared_ptr<tf2_ros::MessageFilter<PointStamped>> filter_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Frames>());
  rclcpp::shutdown();
  return 0;
}
