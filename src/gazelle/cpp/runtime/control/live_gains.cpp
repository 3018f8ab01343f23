#include "live_gains.hpp"

#include <ros/console.h>

#include <algorithm>

namespace control_toolbox {
namespace detail {
namespace {

// The rows of control_toolbox's Parameters.cfg.
struct Row {
  const char* name;
  double Pid::Gains::*gain;
  double lowest, highest;
  const char* description;
};

const Row kRows[] = {
    {"p", &Pid::Gains::p_gain_, -100000.0, 100000.0, "Proportional gain."},
    {"i", &Pid::Gains::i_gain_, -100000.0, 100000.0, "Integral gain."},
    {"d", &Pid::Gains::d_gain_, -1000.0, 1000.0, "Derivative gain."},
    {"i_clamp_min", &Pid::Gains::i_min_, -100000.0, 0.0, "Min bounds for the integral windup"},
    {"i_clamp_max", &Pid::Gains::i_max_, 0.0, 100000.0, "Max bounds for the integral windup"},
};

dynamic_reconfigure::DoubleParameter number(const char* name, double value) {
  dynamic_reconfigure::DoubleParameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

dynamic_reconfigure::Config config_of(double (*value)(const Row&, const Pid::Gains&),
                                      const Pid::Gains& gains, bool antiwindup) {
  dynamic_reconfigure::Config config;
  for (const Row& row : kRows) config.doubles.push_back(number(row.name, value(row, gains)));
  dynamic_reconfigure::BoolParameter flag;
  flag.name = "antiwindup";
  flag.value = antiwindup;
  config.bools.push_back(flag);
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = true;
  group.id = group.parent = 0;
  config.groups.push_back(group);
  return config;
}

dynamic_reconfigure::Config current(const Pid::Gains& gains) {
  return config_of([](const Row& row, const Pid::Gains& from) { return from.*row.gain; }, gains,
                   gains.antiwindup_);
}

dynamic_reconfigure::ConfigDescription description(const Pid::Gains& gains) {
  dynamic_reconfigure::ConfigDescription text;
  dynamic_reconfigure::Group group;
  group.name = "Default";
  group.type = "";
  group.parent = group.id = 0;
  const auto add = [&](const char* name, const char* type, const char* words) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = name;
    parameter.type = type;
    parameter.level = 1;
    parameter.description = words;
    group.parameters.push_back(parameter);
  };
  for (const Row& row : kRows) add(row.name, "double", row.description);
  add("antiwindup", "bool", "Antiwindup.");
  text.groups.push_back(group);
  text.min = config_of([](const Row& row, const Pid::Gains&) { return row.lowest; }, gains, false);
  text.max = config_of([](const Row& row, const Pid::Gains&) { return row.highest; }, gains, true);
  text.dflt = current(gains);
  return text;
}

}  // namespace

LiveGains::LiveGains(const ros::NodeHandle& node, const Pid::Gains& gains)
    : node_(node), gains_(gains) {
  descriptions_ =
      node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  descriptions_.publish(description(gains));
  updates_ = node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  updates_.publish(current(gains));
  service_ = node_.advertiseService("set_parameters", &LiveGains::set, this);
}

bool LiveGains::take(Pid::Gains& gains) {
  if (!changed_.exchange(false)) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  gains = gains_;
  return true;
}

void LiveGains::announce(const Pid::Gains& gains) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    gains_ = gains;
  }
  updates_.publish(current(gains));
}

bool LiveGains::set(dynamic_reconfigure::Reconfigure::Request& request,
                    dynamic_reconfigure::Reconfigure::Response& response) {
  Pid::Gains gains;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    gains = gains_;
    for (const auto& given : request.config.doubles) {
      for (const Row& row : kRows) {
        if (given.name == row.name) {
          gains.*row.gain = std::min(std::max(given.value, row.lowest), row.highest);
        }
      }
    }
    for (const auto& given : request.config.bools) {
      if (given.name == "antiwindup") gains.antiwindup_ = given.value != 0;
    }
    if (gains.i_min_ > gains.i_max_) {
      ROS_ERROR("%s: received i_min > i_max (%g > %g), skip new gains",
                node_.getNamespace().c_str(), gains.i_min_, gains.i_max_);
      gains = gains_;
    } else {
      gains_ = gains;
      changed_ = true;
    }
  }
  response.config = current(gains);
  updates_.publish(response.config);
  return true;
}

}  // namespace detail
}  // namespace control_toolbox
