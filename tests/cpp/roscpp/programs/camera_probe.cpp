// image_transport and camera_info_manager, a word each.

#include <camera_info_manager/camera_info_manager.h>
#include <image_transport/image_transport.h>
#include <image_transport/subscriber_filter.h>
#include <ros/ros.h>

#include <cstdio>
#include <string>

namespace {

void say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

struct Viewer {
  void image(const sensor_msgs::ImageConstPtr& image) {
    say("method " + std::to_string(image->width));
  }
};
void onImage(const sensor_msgs::ImageConstPtr& image) {
  say("function " + std::to_string(image->width));
}

int images(ros::NodeHandle& node) {
  image_transport::ImageTransport transport(node);
  Viewer viewer;
  const sensor_msgs::Image* seen = nullptr;
  image_transport::Subscriber one = transport.subscribe("camera/image", 1, onImage);
  image_transport::Subscriber two = transport.subscribe("camera/image", 1, &Viewer::image, &viewer);
  image_transport::CameraSubscriber both = transport.subscribeCamera(
      "camera/image", 1,
      [&](const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) {
        seen = image.get();
        say("both " + std::to_string(info->width) + " " + both.getInfoTopic());
      });
  image_transport::SubscriberFilter filter(transport, "camera/image", 1);
  filter.registerCallback(
      [&](const sensor_msgs::ImageConstPtr&) { say("filter " + filter.getTransport()); });
  image_transport::CameraPublisher camera = transport.advertiseCamera("camera/image", 1);
  const sensor_msgs::ImagePtr image = boost::make_shared<sensor_msgs::Image>();
  const sensor_msgs::CameraInfoPtr info = boost::make_shared<sensor_msgs::CameraInfo>();
  image->header.stamp = info->header.stamp = ros::Time(5);
  image->width = 640;
  info->width = 641;
  camera.publish(image, info);
  ros::spinOnce();
  ros::spinOnce();
  say(seen == image.get() ? "same image" : "a copy");
  say("ready");
  ros::spin();
  return 0;
}

int calibration(ros::NodeHandle& node, const std::string& file) {
  camera_info_manager::CameraInfoManager manager(node, "left", "file://" + file);
  say(manager.isCalibrated() ? "calibrated" : "not calibrated");
  say("ready");
  while (ros::ok() && !manager.isCalibrated())
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  say("width " + std::to_string(manager.getCameraInfo().width));
  camera_info_manager::CameraInfoManager again(node, "left", "file://" + file);
  say("read " + std::to_string(again.getCameraInfo().K[0]));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "camera");
  ros::NodeHandle node;
  return std::string(argv[1]) == "images" ? images(node) : calibration(node, argv[2]);
}
