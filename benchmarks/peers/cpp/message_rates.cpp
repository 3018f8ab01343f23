// Either end of what bench_cpp.py measures, in roscpp: the same source for Gazelle and for ROS.
//
//   message_rates answer            sends back what comes, counts images
//   message_rates ask ROUNDS IMAGES measures round trips and images of 1 MB, prints them as JSON
//   message_rates inside COUNT      measures small messages inside one process
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/UInt32.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

sensor_msgs::JointState joints() {
  sensor_msgs::JointState state;
  for (int i = 0; i < 6; ++i) {
    state.name.push_back("joint_" + std::to_string(i));
    state.position.push_back(0.1 * i);
    state.velocity.push_back(0.2 * i);
    state.effort.push_back(0.3 * i);
  }
  return state;
}

double now_us() { return ros::WallTime::now().toSec() * 1e6; }

void say(const char *what, std::vector<double> us) {
  std::sort(us.begin(), us.end());
  if (us.empty()) return;
  std::printf("{\"what\": \"%s\", \"p50_us\": %.1f, \"p99_us\": %.1f}\n", what,
              us[us.size() / 2], us[us.size() * 99 / 100]);
  std::fflush(stdout);
}

int answer() {
  ros::NodeHandle node;
  auto pong = node.advertise<sensor_msgs::JointState>("pong", 10);
  auto seen = node.advertise<std_msgs::UInt32>("seen", 10);
  std::uint32_t count = 0;
  auto ping = node.subscribe<sensor_msgs::JointState>(
      "ping", 10, [&](const sensor_msgs::JointState::ConstPtr &one) { pong.publish(one); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  auto image = node.subscribe<sensor_msgs::Image>("image", 10,
                                                  [&](const sensor_msgs::Image::ConstPtr &) {
                                                    std_msgs::UInt32 number;
                                                    number.data = ++count;
                                                    seen.publish(number);
                                                  });
  std::printf("ready\n");
  std::fflush(stdout);
  ros::spin();
  return 0;
}

template <class Publish>
std::vector<double> rounds(int count, const bool &arrived_flag, bool &arrived, Publish publish) {
  std::vector<double> us;
  auto *queue = ros::getGlobalCallbackQueue();
  for (int i = 0; i < count && ros::ok(); ++i) {
    arrived = false;
    const double begin = now_us();
    publish();
    while (!arrived_flag && ros::ok()) queue->callAvailable(ros::WallDuration(0.1));
    us.push_back(now_us() - begin);
  }
  return us;
}

int ask(int round_count, int image_count) {
  ros::NodeHandle node;
  bool arrived = false;
  auto ping = node.advertise<sensor_msgs::JointState>("ping", 10);
  auto image = node.advertise<sensor_msgs::Image>("image", 10);
  auto pong = node.subscribe<sensor_msgs::JointState>(
      "pong", 10, [&](const sensor_msgs::JointState::ConstPtr &) { arrived = true; },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  auto seen = node.subscribe<std_msgs::UInt32>(
      "seen", 10, [&](const std_msgs::UInt32::ConstPtr &) { arrived = true; });
  while (ros::ok() && (ping.getNumSubscribers() == 0 || image.getNumSubscribers() == 0 ||
                       pong.getNumPublishers() == 0 || seen.getNumPublishers() == 0)) {
    ros::WallDuration(0.01).sleep();
  }
  ros::WallDuration(1.0).sleep();
  const auto state = joints();
  rounds(round_count / 10, arrived, arrived, [&] { ping.publish(state); });
  say("round trip", rounds(round_count, arrived, arrived, [&] { ping.publish(state); }));
  sensor_msgs::Image pixels;
  pixels.width = 1000;
  pixels.height = 1000;
  pixels.step = 1000;
  pixels.encoding = "mono8";
  pixels.data.resize(1000000);
  rounds(image_count / 10, arrived, arrived, [&] { image.publish(pixels); });
  say("image of 1 MB", rounds(image_count, arrived, arrived, [&] { image.publish(pixels); }));
  return 0;
}

int inside(int count) {
  ros::NodeHandle node;
  auto publisher = node.advertise<std_msgs::UInt32>("inside", 1000);
  int got = 0;
  auto subscriber = node.subscribe<std_msgs::UInt32>(
      "inside", 1000, [&](const std_msgs::UInt32::ConstPtr &) { ++got; });
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  ros::WallDuration(1.0).sleep();
  const double begin = now_us();
  for (int sent = 0; sent < count; sent += 100) {
    for (int i = 0; i < 100; ++i) {
      boost::shared_ptr<std_msgs::UInt32> one(new std_msgs::UInt32);
      one->data = static_cast<std::uint32_t>(i);
      publisher.publish(one);
    }
    while (got < sent + 100 && ros::ok()) ros::spinOnce();
  }
  std::printf("{\"what\": \"inside a process\", \"messages_per_s\": %.0f}\n",
              count / (now_us() - begin) * 1e6);
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  ros::init(argc, argv, "rates_" + what);
  if (what == "answer") return answer();
  if (what == "ask" && argc > 3) return ask(std::atoi(argv[2]), std::atoi(argv[3]));
  if (what == "inside" && argc > 2) return inside(std::atoi(argv[2]));
  return 2;
}
