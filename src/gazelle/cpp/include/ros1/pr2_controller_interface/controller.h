#pragma once

#include <pr2_mechanism_model/robot.h>
#include <ros/node_handle.h>

#include <boost/shared_ptr.hpp>
#include <string>
#include <vector>

namespace pr2_controller_interface {

class Controller;

// Gives controllers to other controllers that work before or after them.
class ControllerProvider {
 public:
  virtual ~ControllerProvider() = default;
  virtual Controller* getControllerByName(const std::string& name) = 0;
};

// A controller of the PR2: made by its class's name, then init(), starting(), update() at every
// tick of the control loop, stopping().
class Controller {
 public:
  enum { BEFORE_ME, AFTER_ME };
  enum { CONSTRUCTED, INITIALIZED, RUNNING };

  Controller() = default;
  virtual ~Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  virtual bool init(pr2_mechanism_model::RobotState* robot, ros::NodeHandle& n) = 0;
  virtual void starting() {}
  virtual void update() = 0;
  virtual void stopping() {}
  // The forms of Hydro and later, with the time of the tick.
  virtual void starting(const ros::Time& /*time*/) { starting(); }
  virtual void update(const ros::Time& /*time*/, const ros::Duration& /*period*/) { update(); }
  virtual void stopping(const ros::Time& /*time*/) { stopping(); }

  template <class ControllerType>
  bool getController(const std::string& name, int sched, ControllerType*& found) {
    if (provider_ == nullptr) return false;
    found = dynamic_cast<ControllerType*>(provider_->getControllerByName(name));
    if (found == nullptr) return false;
    (sched == BEFORE_ME ? before_list_ : after_list_).push_back(name);
    return true;
  }

  bool isRunning() const { return state_ == RUNNING; }
  void updateRequest(const ros::Time& time, const ros::Duration& period) {
    if (state_ == RUNNING) update(time, period);
  }
  bool startRequest(const ros::Time& time) {
    if (state_ == CONSTRUCTED) return false;
    starting(time);
    state_ = RUNNING;
    return true;
  }
  bool stopRequest(const ros::Time& time) {
    if (state_ == CONSTRUCTED) return false;
    if (state_ == RUNNING) stopping(time);
    state_ = INITIALIZED;
    return true;
  }
  bool initRequest(ControllerProvider* provider, pr2_mechanism_model::RobotState* robot,
                   ros::NodeHandle& n) {
    if (state_ != CONSTRUCTED) return false;
    provider_ = provider;
    if (!init(robot, n)) return false;
    state_ = INITIALIZED;
    return true;
  }

  std::vector<std::string> before_list_, after_list_;
  int state_ = CONSTRUCTED;

 private:
  ControllerProvider* provider_ = nullptr;
};

}  // namespace pr2_controller_interface
