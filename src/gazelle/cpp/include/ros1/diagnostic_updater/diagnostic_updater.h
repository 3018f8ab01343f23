#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>
#include <ros/ros.h>
#include <ros/this_node.h>

#include <algorithm>
#include <string>
#include <vector>

#include "diagnostic_updater/DiagnosticStatusWrapper.h"

namespace diagnostic_updater {

// Has tasks say how they are, once a period (~diagnostic_period, 1 s), on /diagnostics.
class Updater : public DiagnosticTaskVector {
 public:
  bool verbose_ = false;

  Updater(ros::NodeHandle h = ros::NodeHandle(), ros::NodeHandle ph = ros::NodeHandle("~"),
          std::string node_name = ros::this_node::getName())
      : private_node_handle_(ph), node_handle_(h), node_name_(node_name) {
    publisher_ = node_handle_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1);
    private_node_handle_.param("diagnostic_period", period_, 1.0);
    bool with_namespace = false;
    private_node_handle_.param("diagnostic_updater_use_fqn", with_namespace, false);
    if (!with_namespace) node_name_.erase(0, node_name_.rfind('/') + 1);
    next_time_ = ros::Time::now() + ros::Duration(period_);
  }

  // Run the tasks if their time has come; to be called often.
  void update() {
    const ros::Time now = ros::Time::now();
    // Time that jumped back must not keep them silent.
    if (now < next_time_ && now + ros::Duration(period_) >= next_time_) return;
    force_update();
  }
  void force_update() {
    private_node_handle_.getParamCached("diagnostic_period", period_);
    next_time_ = ros::Time::now() + ros::Duration(period_);
    if (!private_node_handle_.ok()) return;
    bool warn_nohwid = hardware_id_.empty();
    auto statuses = run_all(node_name_ + ": ", hardware_id_);
    for (const auto& status : statuses) {
      if (status.level) warn_nohwid = false;
      if (verbose_ && status.level) {
        ROS_WARN("Non-zero diagnostic status. Name: '%s', status %i: '%s'", status.name.c_str(),
                 status.level, status.message.c_str());
      }
    }
    if (warn_nohwid && !warned_) {
      ROS_WARN(
          "diagnostic_updater: No HW_ID was set. This is probably a bug. Please report it. For "
          "devices that do not have a HW_ID, set this value to 'none'. This warning only occurs "
          "once all diagnostics are OK so it is okay to wait until the device is open before "
          "calling setHardwareID.");
      warned_ = true;
    }
    publish(statuses);
  }
  double getPeriod() { return period_; }

  // Say the same for every task.
  void broadcast(int lvl, const std::string msg) {
    std::vector<Status> statuses;
    for (const auto& task : getTasks()) {
      DiagnosticStatusWrapper status;
      status.name = node_name_ + ": " + task.getName();
      status.hardware_id = hardware_id_;
      status.summary(static_cast<unsigned char>(lvl), msg);
      statuses.push_back(status);
    }
    publish(statuses);
  }
  void setHardwareID(const std::string& hwid) { hardware_id_ = hwid; }
  __attribute__((format(printf, 2, 3))) void setHardwareIDf(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char buffer[1000];
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    hardware_id_ = buffer;
  }

  // Of ours: what times of tasks are read from.
  int task_clock() const { return 0; }

 private:
  void publish(std::vector<Status>& statuses) {
    diagnostic_msgs::DiagnosticArray message;
    message.status = statuses;
    message.header.stamp = ros::Time::now();
    publisher_.publish(message);
  }
  void addedTaskCallback(Entry& task) override {
    DiagnosticStatusWrapper status;
    status.name = node_name_ + ": " + task.getName();
    status.summary(0, "Node starting up");
    std::vector<Status> statuses{status};
    publish(statuses);
  }

  ros::NodeHandle private_node_handle_;
  ros::NodeHandle node_handle_;
  ros::Publisher publisher_;
  ros::Time next_time_;
  double period_ = 1.0;
  std::string hardware_id_;
  std::string node_name_;
  bool warned_ = false;
};

}  // namespace diagnostic_updater
