#pragma once

#include <ros/duration.h>
#include <ros/time.h>

#include <map>
#include <string>
#include <utility>

namespace pr2_hardware_interface {

class ActuatorState {
 public:
  double sample_timestamp_ = 0.0;
  int device_id_ = 0;
  double position_ = 0.0;
  double velocity_ = 0.0;
  bool is_enabled_ = true;
  bool halted_ = false;
  double last_commanded_current_ = 0.0;
  double last_executed_current_ = 0.0;
  double last_measured_current_ = 0.0;
  double last_commanded_effort_ = 0.0;
  double last_executed_effort_ = 0.0;
  double last_measured_effort_ = 0.0;
  double max_effort_ = 0.0;
  double motor_voltage_ = 0.0;
  int num_encoder_errors_ = 0;
  double zero_offset_ = 0.0;
};

class ActuatorCommand {
 public:
  bool enable_ = false;
  double effort_ = 0.0;
};

class Actuator {
 public:
  Actuator() = default;
  explicit Actuator(std::string name) : name_(std::move(name)) {}

  std::string name_;
  ActuatorState state_;
  ActuatorCommand command_;
};

using ActuatorMap = std::map<std::string, Actuator*>;

class HardwareInterface {
 public:
  explicit HardwareInterface(bool reset = false) : current_time_(0.0), reset_(reset) {}

  Actuator* getActuator(const std::string& name) const {
    const auto found = actuators_.find(name);
    return found == actuators_.end() ? nullptr : found->second;
  }
  bool addActuator(Actuator* actuator) {
    return actuators_.emplace(actuator->name_, actuator).second;
  }

  ActuatorMap actuators_;
  ros::Time current_time_;
  bool reset_;
};

}  // namespace pr2_hardware_interface
