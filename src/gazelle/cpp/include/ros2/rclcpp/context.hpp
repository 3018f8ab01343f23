#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <unordered_map>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/init_options.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class ContextAlreadyInitialized : public std::runtime_error {
 public:
  ContextAlreadyInitialized() : std::runtime_error("context is already initialized") {}
};

class Context;

/// A function that is called around a shutdown, by the handle that removes it.
struct ShutdownCallbackHandle {
  using ShutdownCallbackType = std::function<void()>;
  std::weak_ptr<ShutdownCallbackType> callback;
};
using OnShutdownCallbackHandle = ShutdownCallbackHandle;
using PreShutdownCallbackHandle = ShutdownCallbackHandle;

/// From `init` to `shutdown`.
class RCLCPP_PUBLIC Context : public std::enable_shared_from_this<Context> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Context)
  using OnShutdownCallback = OnShutdownCallbackHandle::ShutdownCallbackType;
  using PreShutdownCallback = PreShutdownCallbackHandle::ShutdownCallbackType;

  Context();
  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  virtual void init(int argc, char const* const* argv,
                    const InitOptions& init_options = InitOptions());
  bool is_valid() const;
  const InitOptions& get_init_options() const;
  InitOptions get_init_options();
  std::size_t get_domain_id() const;
  std::string shutdown_reason() const;
  virtual bool shutdown(const std::string& reason);
  virtual OnShutdownCallback on_shutdown(OnShutdownCallback callback);
  virtual OnShutdownCallbackHandle add_on_shutdown_callback(OnShutdownCallback callback);
  virtual bool remove_on_shutdown_callback(const OnShutdownCallbackHandle& handle);
  virtual PreShutdownCallbackHandle add_pre_shutdown_callback(PreShutdownCallback callback);
  virtual bool remove_pre_shutdown_callback(const PreShutdownCallbackHandle& handle);
  std::vector<OnShutdownCallback> get_on_shutdown_callbacks() const;
  std::vector<PreShutdownCallback> get_pre_shutdown_callbacks() const;
  bool sleep_for(const std::chrono::nanoseconds& nanoseconds);
  virtual void interrupt_all_sleep_for();

  /// One object of a class for each context.
  template <typename SubContext, typename... Args>
  std::shared_ptr<SubContext> get_sub_context(Args&&... arguments) {
    std::lock_guard<std::recursive_mutex> lock(sub_contexts_mutex_);
    auto& found = sub_contexts_[std::type_index(typeid(SubContext))];
    if (!found) {
      found = std::shared_ptr<void>(new SubContext(std::forward<Args>(arguments)...),
                                    [](void* made) { delete static_cast<SubContext*>(made); });
    }
    return std::static_pointer_cast<SubContext>(found);
  }

  class Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
  std::recursive_mutex sub_contexts_mutex_;
  std::unordered_map<std::type_index, std::shared_ptr<void>> sub_contexts_;
};

RCLCPP_PUBLIC std::vector<Context::SharedPtr> get_contexts();

namespace contexts {

class RCLCPP_PUBLIC DefaultContext : public Context {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(DefaultContext)
  DefaultContext() = default;
};

RCLCPP_PUBLIC DefaultContext::SharedPtr get_global_default_context();

}  // namespace contexts
}  // namespace rclcpp
