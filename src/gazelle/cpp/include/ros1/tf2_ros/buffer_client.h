// A buffer in another node, asked by an action.
#pragma once

#include <string>

#include "actionlib/client/simple_action_client.h"
#include "ros/ros.h"
#include "tf2/exceptions.h"
#include "tf2_msgs/LookupTransformAction.h"
#include "tf2_msgs/TF2Error.h"
#include "tf2_ros/buffer_interface.h"

namespace tf2_ros {

class BufferClient : public BufferInterface {
 public:
  typedef actionlib::SimpleActionClient<tf2_msgs::LookupTransformAction> LookupActionClient;

  explicit BufferClient(std::string ns, double check_frequency = 10.0,
                        ros::Duration timeout_padding = ros::Duration(2.0))
      : client_(ns), timeout_padding_(timeout_padding) {
    static_cast<void>(check_frequency);  // results are waited for, not looked for
  }

  geometry_msgs::TransformStamped lookupTransform(
      const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
      const ros::Duration timeout = ros::Duration(0.0)) const override {
    tf2_msgs::LookupTransformGoal goal;
    goal.target_frame = target_frame;
    goal.source_frame = source_frame;
    goal.source_time = time;
    goal.timeout = timeout;
    goal.advanced = false;
    return ask(goal);
  }
  geometry_msgs::TransformStamped lookupTransform(
      const std::string& target_frame, const ros::Time& target_time,
      const std::string& source_frame, const ros::Time& source_time, const std::string& fixed_frame,
      const ros::Duration timeout = ros::Duration(0.0)) const override {
    tf2_msgs::LookupTransformGoal goal;
    goal.target_frame = target_frame;
    goal.source_frame = source_frame;
    goal.source_time = source_time;
    goal.timeout = timeout;
    goal.target_time = target_time;
    goal.fixed_frame = fixed_frame;
    goal.advanced = true;
    return ask(goal);
  }
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const ros::Time& time, const ros::Duration timeout = ros::Duration(0.0),
                    std::string* errstr = nullptr) const override {
    return succeeds([&] { lookupTransform(target_frame, source_frame, time, timeout); }, errstr);
  }
  bool canTransform(const std::string& target_frame, const ros::Time& target_time,
                    const std::string& source_frame, const ros::Time& source_time,
                    const std::string& fixed_frame,
                    const ros::Duration timeout = ros::Duration(0.0),
                    std::string* errstr = nullptr) const override {
    return succeeds(
        [&] {
          lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame,
                          timeout);
        },
        errstr);
  }
  bool waitForServer(const ros::Duration& timeout = ros::Duration(0)) {
    return client_.waitForServer(timeout);
  }

 private:
  template <class Function>
  static bool succeeds(Function function, std::string* why) {
    try {
      function();
    } catch (const tf2::TransformException& error) {
      if (why != nullptr) *why = error.what();
      return false;
    }
    return true;
  }
  geometry_msgs::TransformStamped ask(const tf2_msgs::LookupTransformGoal& goal) const {
    client_.sendGoal(goal);
    if (!client_.waitForResult(goal.timeout + timeout_padding_)) {
      client_.cancelGoal();
      throw tf2::TimeoutException(
          "The LookupTransform goal sent to the BufferServer did not come back in the specified "
          "time. Something is likely wrong with the server");
    }
    if (client_.getState() != actionlib::SimpleClientGoalState::SUCCEEDED)
      throw tf2::TimeoutException(
          "The LookupTransform goal sent to the BufferServer did not come back with SUCCEEDED "
          "status. Something is likely wrong with the server.");
    const auto result = client_.getResult();
    const std::string& text = result->error.error_string;
    switch (result->error.error) {
      case tf2_msgs::TF2Error::NO_ERROR:
        return result->transform;
      case tf2_msgs::TF2Error::LOOKUP_ERROR:
        throw tf2::LookupException(text);
      case tf2_msgs::TF2Error::CONNECTIVITY_ERROR:
        throw tf2::ConnectivityException(text);
      case tf2_msgs::TF2Error::EXTRAPOLATION_ERROR:
        throw tf2::ExtrapolationException(text);
      case tf2_msgs::TF2Error::INVALID_ARGUMENT_ERROR:
        throw tf2::InvalidArgumentException(text);
      case tf2_msgs::TF2Error::TIMEOUT_ERROR:
        throw tf2::TimeoutException(text);
      default:
        throw tf2::TransformException(text);
    }
  }

  mutable LookupActionClient client_;
  ros::Duration timeout_padding_;
};

}  // namespace tf2_ros
