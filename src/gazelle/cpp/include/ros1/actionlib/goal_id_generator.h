#pragma once

#include <actionlib_msgs/GoalID.h>
#include <ros/this_node.h>
#include <ros/time.h>

#include <atomic>
#include <string>

namespace actionlib {

/// Names goals: node, number of the goal in this process, time.
class GoalIDGenerator {
 public:
  GoalIDGenerator() : name_(ros::this_node::getName()) {}
  GoalIDGenerator(const std::string& name) : name_(name) {}
  void setName(const std::string& name) { name_ = name; }

  actionlib_msgs::GoalID generateID() {
    static std::atomic<unsigned> count{0};
    actionlib_msgs::GoalID id;
    const ros::Time now = ros::Time::now();
    id.id = name_ + "-" + std::to_string(++count) + "-" + std::to_string(now.sec) + "." +
            std::to_string(now.nsec);
    id.stamp = now;
    return id;
  }

 private:
  std::string name_;
};

}  // namespace actionlib
