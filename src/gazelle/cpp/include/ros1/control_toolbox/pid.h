#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <boost/shared_ptr.hpp>
#include <memory>
#include <string>

class TiXmlElement;

namespace control_toolbox {

namespace detail {
class LiveGains;
}

// A PID of the error `target - state`; its gains can be changed while it runs.
class Pid {
 public:
  struct Gains {
    Gains() : Gains(0.0, 0.0, 0.0, 0.0, 0.0) {}
    Gains(double p, double i, double d, double i_max, double i_min)
        : Gains(p, i, d, i_max, i_min, false) {}
    Gains(double p, double i, double d, double i_max, double i_min, bool antiwindup)
        : p_gain_(p),
          i_gain_(i),
          d_gain_(d),
          i_max_(i_max),
          i_min_(i_min),
          antiwindup_(antiwindup) {}

    double p_gain_;
    double i_gain_;
    double d_gain_;
    double i_max_;  // bounds of what the integral adds to the command
    double i_min_;
    bool antiwindup_;  // bound the integral itself and not only what it adds
  };

  Pid(double p = 0.0, double i = 0.0, double d = 0.0, double i_max = 0.0, double i_min = -0.0,
      bool antiwindup = false);
  // A copy has the gains, but is not changed by others, and has no errors yet.
  Pid(const Pid& source);
  Pid& operator=(const Pid& source);
  ~Pid();

  void initPid(double p, double i, double d, double i_max, double i_min);
  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup);
  void initPid(double p, double i, double d, double i_max, double i_min,
               const ros::NodeHandle& node);
  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup,
               const ros::NodeHandle& node);
  // Read p, i, d, i_clamp … below a namespace and have them changed live from now on. False, and
  // an error on the console unless `quiet`, where there is no p.
  bool initParam(const std::string& prefix, const bool quiet = false);
  bool init(const ros::NodeHandle& n, const bool quiet = false);
  void initDynamicReconfig(ros::NodeHandle& node);

  // Forget errors, integral and command.
  void reset();

  void getGains(double& p, double& i, double& d, double& i_max, double& i_min) const;
  void getGains(double& p, double& i, double& d, double& i_max, double& i_min,
                bool& antiwindup) const;
  Gains getGains() const;
  void setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup = false);
  void setGains(const Gains& gains);
  // Tell others of gains that were set here.
  void updateDynamicReconfig();
  void updateDynamicReconfig(Gains gains_config);

  double computeCommand(double error, ros::Duration dt);
  double computeCommand(double error, double error_dot, ros::Duration dt);

  // Of the time when errors were `state - target`.
  double updatePid(double p_error, ros::Duration dt);
  double updatePid(double error, double error_dot, ros::Duration dt);

  void setCurrentCmd(double cmd);
  double getCurrentCmd() const;
  void getCurrentPIDErrors(double* pe, double* ie, double* de);
  void printValues();

 private:
  Gains gains_;
  std::unique_ptr<detail::LiveGains> live_;
  double p_error_last_ = 0.0;
  double p_error_ = 0.0;
  double i_error_ = 0.0;
  double d_error_ = 0.0;
  double cmd_ = 0.0;
};

}  // namespace control_toolbox
