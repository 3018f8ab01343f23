#pragma once

#include <control_toolbox/pid.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <atomic>
#include <mutex>

namespace control_toolbox {
namespace detail {

// The gains of a PID as dynamic_reconfigure offers them: a service to set them, and two latched
// topics that say what there is and what it is now.
class LiveGains {
 public:
  LiveGains(const ros::NodeHandle& node, const Pid::Gains& gains);

  // Take over gains that somebody has set since the last time; false where nobody has.
  bool take(Pid::Gains& gains);
  // Tell others of gains that were set by the program.
  void announce(const Pid::Gains& gains);

 private:
  bool set(dynamic_reconfigure::Reconfigure::Request& request,
           dynamic_reconfigure::Reconfigure::Response& response);

  ros::NodeHandle node_;
  std::mutex mutex_;
  Pid::Gains gains_;
  std::atomic<bool> changed_{false};
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace detail
}  // namespace control_toolbox
