// A node of dynamic_reconfigure that tells what it hears, and with an argument asks itself.
#include <dynamic_reconfigure/client.h>
#include <dynamic_reconfigure/server.h>
#include <my_package/ArmConfig.h>
#include <ros/ros.h>

#include <cstdio>

void told(my_package::ArmConfig& config, uint32_t level) {
  std::printf("size %d gain %.2f name %s on %d level %x\n", config.size, config.gain,
              config.name.c_str(), config.on, level);
  if (config.name == "wrong") {
    config.name = "right";
  }
  std::fflush(stdout);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "arm");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  dynamic_reconfigure::Server<my_package::ArmConfig> server;
  server.setCallback(boost::bind(&told, _1, _2));
  dynamic_reconfigure::Client<my_package::ArmConfig> client("/arm");
  my_package::ArmConfig config;
  if (!client.getMaxConfiguration(config, ros::Duration(30))) {
    return 1;
  }
  std::printf("largest %d of %d\n", config.size, my_package::Arm_Large);
  std::fflush(stdout);
  ros::waitForShutdown();
  return 0;
}
