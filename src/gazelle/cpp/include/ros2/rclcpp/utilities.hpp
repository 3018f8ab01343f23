#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rclcpp/context.hpp"
#include "rclcpp/init_options.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

enum class SignalHandlerOptions { None, SigInt, SigTerm, All };

RCLCPP_PUBLIC void init(int argc, char const* const* argv,
                        const InitOptions& init_options = InitOptions(),
                        SignalHandlerOptions signal_handler_options = SignalHandlerOptions::All);
RCLCPP_PUBLIC bool install_signal_handlers(
    SignalHandlerOptions signal_handler_options = SignalHandlerOptions::All);
RCLCPP_PUBLIC bool signal_handlers_installed();
RCLCPP_PUBLIC SignalHandlerOptions get_current_signal_handler_options();
RCLCPP_PUBLIC bool uninstall_signal_handlers();
RCLCPP_PUBLIC std::vector<std::string> init_and_remove_ros_arguments(
    int argc, char const* const* argv, const InitOptions& init_options = InitOptions());
/// The words of a command line that are not ROS's, with the program's name.
RCLCPP_PUBLIC std::vector<std::string> remove_ros_arguments(int argc, char const* const* argv);
RCLCPP_PUBLIC std::vector<std::string> remove_ros_arguments(const std::vector<std::string>& words);
RCLCPP_PUBLIC bool ok(Context::SharedPtr context = nullptr);
RCLCPP_PUBLIC bool is_initialized(Context::SharedPtr context = nullptr);
RCLCPP_PUBLIC bool shutdown(Context::SharedPtr context = nullptr,
                            const std::string& reason = "user called rclcpp::shutdown()");
RCLCPP_PUBLIC void on_shutdown(std::function<void()> callback,
                               Context::SharedPtr context = nullptr);
RCLCPP_PUBLIC bool sleep_for(const std::chrono::nanoseconds& nanoseconds,
                             Context::SharedPtr context = nullptr);

/// Whether `x + y` is more, or less, than the type holds.
template <typename T>
bool add_will_overflow(const T x, const T y) {
  T sum;
  return y > 0 && __builtin_add_overflow(x, y, &sum);
}
template <typename T>
bool add_will_underflow(const T x, const T y) {
  T sum;
  return y < 0 && __builtin_add_overflow(x, y, &sum);
}
template <typename T>
bool sub_will_overflow(const T x, const T y) {
  T difference;
  return y < 0 && __builtin_sub_overflow(x, y, &difference);
}
template <typename T>
bool sub_will_underflow(const T x, const T y) {
  T difference;
  return y > 0 && __builtin_sub_overflow(x, y, &difference);
}

inline const char* get_c_string(const char* text) { return text; }
inline const char* get_c_string(const std::string& text) { return text.c_str(); }
RCLCPP_PUBLIC std::vector<const char*> get_c_vector_string(const std::vector<std::string>& texts);

}  // namespace rclcpp
