// A node of ROS 1 that sends frames by tf and tf2, hears of others, and holds points back.
#include <geometry_msgs/PointStamped.h>
#include <message_filters/subscriber.h>
#include <ros/ros.h>
#include <tf/message_filter.h>
#include <tf/transform_broadcaster.h>
#include <tf/transform_listener.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <cstdio>

namespace {

void said(const char* what, const geometry_msgs::Point& point) {
  std::printf("%s %.3f %.3f %.3f\n", what, point.x, point.y, point.z);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "frames");
  ros::NodeHandle node;

  tf2_ros::StaticTransformBroadcaster still;
  geometry_msgs::TransformStamped mount;
  mount.header.frame_id = "base_link";
  mount.child_frame_id = "camera";
  mount.transform.translation.z = 0.5;
  mount.transform.rotation.w = 1.0;
  still.sendTransform(mount);
  mount.child_frame_id = "laser";
  still.sendTransform(mount);

  tf::TransformBroadcaster moving;
  ros::Timer timer = node.createTimer(ros::Duration(0.02), [&](const ros::TimerEvent&) {
    tf::Transform pose(tf::createQuaternionFromYaw(M_PI / 2), tf::Vector3(1.0, 2.0, 0.0));
    moving.sendTransform(tf::StampedTransform(pose, ros::Time::now(), "/odom", "/base_link"));
  });

  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  tf::TransformListener old_listener;

  message_filters::Subscriber<geometry_msgs::PointStamped> points(node, "points", 10);
  tf2_ros::MessageFilter<geometry_msgs::PointStamped> filter(points, buffer, "odom", 10, node);
  filter.registerCallback([&](const geometry_msgs::PointStampedConstPtr& point) {
    said("filtered", buffer.transform(*point, "odom").point);
  });
  filter.registerFailureCallback(
      [](const geometry_msgs::PointStampedConstPtr& point, tf2_ros::FilterFailureReason reason) {
        std::printf("given up %s %d\n", point->header.frame_id.c_str(), static_cast<int>(reason));
        std::fflush(stdout);
      });
  tf::MessageFilter<geometry_msgs::PointStamped> old_filter(points, old_listener, "odom", 10);
  old_filter.registerCallback([&](const geometry_msgs::PointStampedConstPtr& point) {
    geometry_msgs::PointStamped out;
    old_listener.transformPoint("odom", *point, out);
    said("old", out.point);
  });

  ros::AsyncSpinner spinner(1);
  spinner.start();
  std::string why;
  if (buffer.canTransform("odom", "gripper", ros::Time(0), ros::Duration(20.0), &why)) {
    const auto found = buffer.lookupTransform("odom", "gripper", ros::Time(0));
    geometry_msgs::Point point;
    tf2::Vector3 where;
    tf2::fromMsg(found.transform.translation, where);
    said("gripper", tf2::toMsg(where, point));
  } else {
    std::printf("never: %s\n", why.c_str());
    std::fflush(stdout);
  }
  try {
    buffer.lookupTransform("odom", "nowhere", ros::Time(0));
  } catch (const tf2::TransformException& error) {
    std::printf("error %s\n", error.what());
    std::fflush(stdout);
  }
  ros::waitForShutdown();
  return 0;
}
