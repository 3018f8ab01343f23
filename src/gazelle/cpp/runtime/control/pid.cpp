#include "control_toolbox/pid.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "live_gains.hpp"

namespace control_toolbox {
namespace {

// Sums and products stand in the order in which gazelle.control.pid has them: both give the same
// bits.
double clamped(double value, double low, double high) {
  if (value > high) return high;
  if (value < low) return low;
  return value;
}

}  // namespace

Pid::Pid(double p, double i, double d, double i_max, double i_min, bool antiwindup)
    : gains_(p, i, d, i_max, i_min, antiwindup) {}

Pid::Pid(const Pid& source) : gains_(source.getGains()) {}

Pid& Pid::operator=(const Pid& source) {
  if (this != &source) {
    gains_ = source.getGains();
    live_.reset();
    reset();
  }
  return *this;
}

Pid::~Pid() = default;

void Pid::initPid(double p, double i, double d, double i_max, double i_min) {
  initPid(p, i, d, i_max, i_min, false);
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup) {
  setGains(p, i, d, i_max, i_min, antiwindup);
  reset();
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min,
                  const ros::NodeHandle& node) {
  initPid(p, i, d, i_max, i_min, false, node);
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup,
                  const ros::NodeHandle& node) {
  initPid(p, i, d, i_max, i_min, antiwindup);
  ros::NodeHandle own(node);
  initDynamicReconfig(own);
}

bool Pid::initParam(const std::string& prefix, const bool quiet) {
  return init(ros::NodeHandle(prefix), quiet);
}

bool Pid::init(const ros::NodeHandle& n, const bool quiet) {
  ros::NodeHandle node(n);
  Gains gains;
  if (!node.getParam("p", gains.p_gain_)) {
    if (!quiet) {
      ROS_ERROR("No p gain specified for pid.  Namespace: %s", node.getNamespace().c_str());
    }
    return false;
  }
  node.param("i", gains.i_gain_, 0.0);
  node.param("d", gains.d_gain_, 0.0);
  double clamp = 0.0;
  node.param("i_clamp", clamp, 0.0);
  clamp = std::fabs(clamp);
  double high = clamp, low = clamp;
  node.param("i_clamp_max", high, clamp);
  node.param("i_clamp_min", low, clamp);
  gains.i_max_ = std::fabs(high);
  gains.i_min_ = -std::fabs(low);
  node.param("antiwindup", gains.antiwindup_, false);
  setGains(gains);
  reset();
  initDynamicReconfig(node);
  return true;
}

void Pid::initDynamicReconfig(ros::NodeHandle& node) {
  ROS_DEBUG_STREAM_NAMED("pid",
                         "Initializing dynamic reconfigure in namespace " << node.getNamespace());
  live_.reset(new detail::LiveGains(node, gains_));
}

void Pid::reset() { p_error_last_ = p_error_ = i_error_ = d_error_ = cmd_ = 0.0; }

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min) const {
  bool antiwindup;
  getGains(p, i, d, i_max, i_min, antiwindup);
}

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min,
                   bool& antiwindup) const {
  const Gains gains = getGains();
  p = gains.p_gain_;
  i = gains.i_gain_;
  d = gains.d_gain_;
  i_max = gains.i_max_;
  i_min = gains.i_min_;
  antiwindup = gains.antiwindup_;
}

Pid::Gains Pid::getGains() const {
  if (live_) live_->take(const_cast<Pid*>(this)->gains_);
  return gains_;
}

void Pid::setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup) {
  setGains(Gains(p, i, d, i_max, i_min, antiwindup));
}

void Pid::setGains(const Gains& gains) {
  if (gains.i_min_ > gains.i_max_) {
    ROS_ERROR("Received i_min > i_max, skip new gains");
    return;
  }
  gains_ = gains;
  updateDynamicReconfig(gains);
}

void Pid::updateDynamicReconfig() { updateDynamicReconfig(getGains()); }

void Pid::updateDynamicReconfig(Gains gains_config) {
  if (live_) live_->announce(gains_config);
}

double Pid::computeCommand(double error, ros::Duration dt) {
  const double period = dt.toSec();
  if (period <= 0.0 || !std::isfinite(error)) return 0.0;
  const double rate = (error - p_error_last_) / period;
  p_error_last_ = error;
  return computeCommand(error, rate, dt);
}

double Pid::computeCommand(double error, double error_dot, ros::Duration dt) {
  if (live_) live_->take(gains_);
  const double period = dt.toSec();
  if (period <= 0.0 || !std::isfinite(error) || !std::isfinite(error_dot)) return 0.0;
  p_error_ = error;
  d_error_ = error_dot;
  i_error_ += period * error;
  double added;
  if (gains_.antiwindup_) {
    if (gains_.i_gain_ != 0.0) {
      const double a = gains_.i_min_ / gains_.i_gain_, b = gains_.i_max_ / gains_.i_gain_;
      i_error_ = clamped(i_error_, std::min(a, b), std::max(a, b));
    }
    added = gains_.i_gain_ * i_error_;
  } else {
    added = clamped(gains_.i_gain_ * i_error_, gains_.i_min_, gains_.i_max_);
  }
  cmd_ = gains_.p_gain_ * error + added + gains_.d_gain_ * error_dot;
  return cmd_;
}

double Pid::updatePid(double p_error, ros::Duration dt) { return computeCommand(-p_error, dt); }

double Pid::updatePid(double error, double error_dot, ros::Duration dt) {
  return computeCommand(-error, -error_dot, dt);
}

void Pid::setCurrentCmd(double cmd) { cmd_ = cmd; }

double Pid::getCurrentCmd() const { return cmd_; }

void Pid::getCurrentPIDErrors(double* pe, double* ie, double* de) {
  *pe = p_error_;
  *ie = i_error_;
  *de = d_error_;
}

void Pid::printValues() {
  const Gains gains = getGains();
  ROS_INFO_STREAM("Current Values of PID Class:\n"
                  << "  P Gain:       " << gains.p_gain_ << "\n"
                  << "  I Gain:       " << gains.i_gain_ << "\n"
                  << "  D Gain:       " << gains.d_gain_ << "\n"
                  << "  I_Max:        " << gains.i_max_ << "\n"
                  << "  I_Min:        " << gains.i_min_ << "\n"
                  << "  Antiwindup:   " << gains.antiwindup_ << "\n"
                  << "  P_Error_Last: " << p_error_last_ << "\n"
                  << "  P_Error:      " << p_error_ << "\n"
                  << "  I_Error:      " << i_error_ << "\n"
                  << "  D_Error:      " << d_error_ << "\n"
                  << "  Command:      " << cmd_);
}

}  // namespace control_toolbox
