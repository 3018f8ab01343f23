#pragma once

#include <pr2_hardware_interface/hardware_interface.h>
#include <pr2_mechanism_model/joint.h>
#include <ros/time.h>
#include <urdf/model.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pr2_mechanism_model {

// The robot's description and hardware.
class Robot {
 public:
  explicit Robot(pr2_hardware_interface::HardwareInterface* hw) : hw_(hw) {}

  pr2_hardware_interface::Actuator* getActuator(const std::string& name) const {
    return hw_->getActuator(name);
  }
  ros::Time getTime() { return hw_->current_time_; }

  urdf::Model robot_model_;
  pr2_hardware_interface::HardwareInterface* hw_;
};

// The state of the robot, which a controller is given in init().
class RobotState {
 public:
  explicit RobotState(Robot* model) : model_(model) {}
  RobotState(const RobotState&) = delete;
  RobotState& operator=(const RobotState&) = delete;

  // A joint that has an actuator, null where there is none of this name. Asking for it in init()
  // is what claims its effort for the controller.
  JointState* getJointState(const std::string& name) {
    const auto found = joint_states_map_.find(name);
    if (found == joint_states_map_.end()) return nullptr;
    if (asked_) asked_(name);
    return found->second;
  }
  const JointState* getJointState(const std::string& name) const {
    const auto found = joint_states_map_.find(name);
    return found == joint_states_map_.end() ? nullptr : found->second;
  }

  ros::Time getTime() { return model_->getTime(); }
  bool isHalted() { return false; }
  void zeroCommands() {
    for (JointState& joint : joint_states_) joint.commanded_effort_ = 0.0;
  }
  void enforceSafety() {
    for (JointState& joint : joint_states_) joint.enforceLimits();
  }

  Robot* model_;
  std::vector<JointState> joint_states_;
  std::map<std::string, JointState*> joint_states_map_;

  // Of ours: hears of the joints that are asked for.
  std::function<void(const std::string&)> asked_;
};

}  // namespace pr2_mechanism_model
