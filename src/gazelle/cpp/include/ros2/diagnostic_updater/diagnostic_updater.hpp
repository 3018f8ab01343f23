#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "diagnostic_msgs/msg/diagnostic_array.hpp"
#include "diagnostic_updater/diagnostic_status_wrapper.hpp"
#include "rclcpp/rclcpp.hpp"

namespace diagnostic_updater {

// Has tasks say how they are, once a period (parameter diagnostic_updater.period, 1 s), on
// /diagnostics; a timer of the node calls it.
class Updater : public DiagnosticTaskVector {
 public:
  bool verbose_ = false;

  template <class NodeT>
  explicit Updater(NodeT node, double period = 1.0)
      : Updater(node->get_node_base_interface(), node->get_node_clock_interface(),
                node->get_node_logging_interface(), node->get_node_parameters_interface(),
                node->get_node_timers_interface(), node->get_node_topics_interface(), period) {}

  Updater(std::shared_ptr<rclcpp::node_interfaces::NodeBaseInterface> base_interface,
          std::shared_ptr<rclcpp::node_interfaces::NodeClockInterface> clock_interface,
          std::shared_ptr<rclcpp::node_interfaces::NodeLoggingInterface> logging_interface,
          std::shared_ptr<rclcpp::node_interfaces::NodeParametersInterface> parameters_interface,
          std::shared_ptr<rclcpp::node_interfaces::NodeTimersInterface> timers_interface,
          std::shared_ptr<rclcpp::node_interfaces::NodeTopicsInterface> topics_interface,
          double period = 1.0)
      : base_(base_interface),
        timers_(timers_interface),
        clock_(clock_interface->get_clock()),
        period_(rclcpp::Duration::from_seconds(period)),
        publisher_(rclcpp::create_publisher<diagnostic_msgs::msg::DiagnosticArray>(
            parameters_interface, topics_interface, "/diagnostics", rclcpp::QoS(1))),
        logger_(logging_interface->get_logger()),
        node_name_(base_interface->get_name()) {
    const auto read = [&](const char* name, const rclcpp::ParameterValue& fallback) {
      return parameters_interface->has_parameter(name)
                 ? parameters_interface->get_parameter(name).get_parameter_value()
                 : parameters_interface->declare_parameter(name, fallback);
    };
    period = read("diagnostic_updater.period", rclcpp::ParameterValue(period)).get<double>();
    if (read("diagnostic_updater.use_fqn", rclcpp::ParameterValue(false)).get<bool>()) {
      node_name_ = base_interface->get_fully_qualified_name();
    }
    period_ = rclcpp::Duration::from_seconds(period);
    reset_timer();
  }

  auto getPeriod() const { return period_; }
  void setPeriod(rclcpp::Duration period) {
    period_ = period;
    reset_timer();
  }
  void setPeriod(double period) { setPeriod(rclcpp::Duration::from_seconds(period)); }

  void force_update() { update(); }

  // Say the same for every task.
  void broadcast(unsigned char lvl, const std::string msg) {
    std::vector<Status> statuses;
    for (const auto& task : getTasks()) {
      DiagnosticStatusWrapper status;
      status.name = node_name_ + ": " + task.getName();
      status.summary(lvl, msg);
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
  rclcpp::Clock::SharedPtr task_clock() const { return clock_; }

 private:
  void reset_timer() {
    timer_ = rclcpp::create_timer(base_, timers_, clock_, period_, [this]() { update(); });
  }
  void update() {
    if (!rclcpp::ok()) return;
    bool warn_nohwid = hardware_id_.empty();
    auto statuses = run_all(node_name_ + ": ", hardware_id_);
    for (const auto& status : statuses) {
      if (status.level) warn_nohwid = false;
      if (verbose_ && status.level) {
        RCLCPP_WARN(logger_, "Non-zero diagnostic status. Name: '%s', status %i: '%s'",
                    status.name.c_str(), status.level, status.message.c_str());
      }
    }
    if (warn_nohwid && !warned_) {
      RCLCPP_WARN(logger_,
                  "diagnostic_updater: No HW_ID was set. This is probably a bug. Please report "
                  "it. For devices that do not have a HW_ID, set this value to 'none'. This "
                  "warning only occurs once all diagnostics are OK. It is okay to wait until the "
                  "device is open before calling setHardwareID.");
      warned_ = true;
    }
    publish(statuses);
  }
  void publish(std::vector<Status>& statuses) {
    diagnostic_msgs::msg::DiagnosticArray message;
    message.status = statuses;
    message.header.stamp = clock_->now();
    publisher_->publish(message);
  }
  void addedTaskCallback(Entry& task) override {
    DiagnosticStatusWrapper status;
    status.name = node_name_ + ": " + task.getName();
    status.summary(0, "Node starting up");
    std::vector<Status> statuses{status};
    publish(statuses);
  }

  std::shared_ptr<rclcpp::node_interfaces::NodeBaseInterface> base_;
  std::shared_ptr<rclcpp::node_interfaces::NodeTimersInterface> timers_;
  rclcpp::Clock::SharedPtr clock_;
  rclcpp::Duration period_;
  rclcpp::TimerBase::SharedPtr timer_;
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr publisher_;
  rclcpp::Logger logger_;
  std::string hardware_id_;
  std::string node_name_;
  bool warned_ = false;
};

}  // namespace diagnostic_updater
