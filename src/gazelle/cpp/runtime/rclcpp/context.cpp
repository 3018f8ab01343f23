// From rclcpp::init to rclcpp::shutdown.
#include "rclcpp/context.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <utility>

#include "gazelle/core.hpp"
#include "rclcpp/detail/log_arguments.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

class Context::Impl {
 public:
  std::atomic<bool> valid{false};
  std::mutex mutex;
  std::string reason;
  InitOptions options;
  std::uint64_t listener = 0;
  std::vector<std::shared_ptr<ShutdownCallbackHandle::ShutdownCallbackType>> before, after;
  std::atomic<std::uint64_t> interrupted{0};
};

namespace {

std::mutex& contexts_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<std::weak_ptr<Context>>& all_contexts() {
  static std::vector<std::weak_ptr<Context>> contexts;
  return contexts;
}

std::atomic<SignalHandlerOptions>& signal_options() {
  static std::atomic<SignalHandlerOptions> options{SignalHandlerOptions::None};
  return options;
}

Context::SharedPtr or_default(Context::SharedPtr context) {
  return context ? context : contexts::get_global_default_context();
}

using Callbacks = std::vector<std::shared_ptr<ShutdownCallbackHandle::ShutdownCallbackType>>;

bool erase(Callbacks& callbacks, const ShutdownCallbackHandle& handle) {
  const auto strong = handle.callback.lock();
  const auto found = std::find(callbacks.begin(), callbacks.end(), strong);
  if (!strong || found == callbacks.end()) return false;
  callbacks.erase(found);
  return true;
}

}  // namespace

Context::Context() : impl_(std::make_unique<Impl>()) {}

Context::~Context() {
  if (impl_->listener) gazelle::remove_shutdown_listener(impl_->listener);
}

void Context::init(int argc, char const* const* argv, const InitOptions& init_options) {
  if (impl_->valid) throw ContextAlreadyInitialized();
  std::vector<std::string> words;
  for (int i = 1; i < argc && argv; ++i) words.emplace_back(argv[i]);
  try {
    gazelle::set_arguments(2, words);
  } catch (const gazelle::Error& error) {
    throw exceptions::RCLInvalidROSArgsError(
        RCL_RET_INVALID_ROS_ARGS, std::string("failed to initialize rcl: ") + error.what());
  }
  detail::use_log_arguments(words);
  gazelle::reset_shutdown();
  impl_->options = init_options;
  impl_->reason.clear();
  impl_->valid = true;
  {
    std::lock_guard<std::mutex> lock(contexts_mutex());
    auto& all = all_contexts();
    all.erase(std::remove_if(all.begin(), all.end(), [](const auto& one) { return one.expired(); }),
              all.end());
    all.push_back(weak_from_this());
  }
  if (init_options.shutdown_on_signal && !impl_->listener) {
    std::weak_ptr<Context> weak = weak_from_this();
    impl_->listener = gazelle::on_shutdown([weak](const std::string& reason) {
      if (const auto self = weak.lock()) {
        self->shutdown(reason.compare(0, 6, "signal") == 0 ? "signal handler" : reason);
      }
    });
  }
}

bool Context::is_valid() const { return impl_->valid; }
const InitOptions& Context::get_init_options() const { return impl_->options; }
InitOptions Context::get_init_options() { return impl_->options; }

std::size_t Context::get_domain_id() const {
  return static_cast<std::size_t>(gazelle::call("graph/domain").as_int());
}

std::string Context::shutdown_reason() const {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->reason;
}

bool Context::shutdown(const std::string& reason) {
  Callbacks before, after;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    if (!impl_->valid) return false;
    before = impl_->before;
  }
  for (const auto& one : before) (*one)();
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    if (!impl_->valid.exchange(false)) return false;
    impl_->reason = reason;
    after = impl_->after;
  }
  for (const auto& one : after) (*one)();
  interrupt_all_sleep_for();
  return true;
}

Context::OnShutdownCallback Context::on_shutdown(OnShutdownCallback callback) {
  add_on_shutdown_callback(callback);
  return callback;
}

OnShutdownCallbackHandle Context::add_on_shutdown_callback(OnShutdownCallback callback) {
  auto kept = std::make_shared<OnShutdownCallback>(std::move(callback));
  std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->after.push_back(kept);
  return {kept};
}

bool Context::remove_on_shutdown_callback(const OnShutdownCallbackHandle& handle) {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  return erase(impl_->after, handle);
}

PreShutdownCallbackHandle Context::add_pre_shutdown_callback(PreShutdownCallback callback) {
  auto kept = std::make_shared<PreShutdownCallback>(std::move(callback));
  std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->before.push_back(kept);
  return {kept};
}

bool Context::remove_pre_shutdown_callback(const PreShutdownCallbackHandle& handle) {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  return erase(impl_->before, handle);
}

std::vector<Context::OnShutdownCallback> Context::get_on_shutdown_callbacks() const {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  std::vector<OnShutdownCallback> copies;
  for (const auto& one : impl_->after) copies.push_back(*one);
  return copies;
}

std::vector<Context::PreShutdownCallback> Context::get_pre_shutdown_callbacks() const {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  std::vector<PreShutdownCallback> copies;
  for (const auto& one : impl_->before) copies.push_back(*one);
  return copies;
}

bool Context::sleep_for(const std::chrono::nanoseconds& nanoseconds) {
  const std::uint64_t seen = impl_->interrupted;
  gazelle::clock::wait_wall(nanoseconds.count(),
                            [this, seen]() { return impl_->interrupted != seen; });
  return is_valid();
}

void Context::interrupt_all_sleep_for() {
  impl_->interrupted.fetch_add(1);
  gazelle::clock::notify_waiters();
}

std::vector<Context::SharedPtr> get_contexts() {
  std::vector<Context::SharedPtr> strong;
  std::lock_guard<std::mutex> lock(contexts_mutex());
  for (const auto& one : all_contexts()) {
    if (auto found = one.lock()) strong.push_back(std::move(found));
  }
  return strong;
}

namespace contexts {

DefaultContext::SharedPtr get_global_default_context() {
  // Never destroyed: nodes that are static variables may outlive everything here.
  static auto* context = new DefaultContext::SharedPtr(std::make_shared<DefaultContext>());
  return *context;
}

}  // namespace contexts

void init(int argc, char const* const* argv, const InitOptions& init_options,
          SignalHandlerOptions signal_handler_options) {
  contexts::get_global_default_context()->init(argc, argv, init_options);
  install_signal_handlers(signal_handler_options);
}

bool install_signal_handlers(SignalHandlerOptions options) {
  if (signal_handlers_installed()) return false;
  std::vector<int> numbers;
  if (options == SignalHandlerOptions::All || options == SignalHandlerOptions::SigInt) {
    numbers.push_back(SIGINT);
  }
  if (options == SignalHandlerOptions::All || options == SignalHandlerOptions::SigTerm) {
    numbers.push_back(SIGTERM);
  }
  signal_options() = options;
  if (!numbers.empty()) gazelle::install_signal_handlers(numbers);
  return true;
}

bool signal_handlers_installed() { return signal_options() != SignalHandlerOptions::None; }
SignalHandlerOptions get_current_signal_handler_options() { return signal_options(); }

bool uninstall_signal_handlers() {
  if (!signal_handlers_installed()) return false;
  signal_options() = SignalHandlerOptions::None;
  gazelle::uninstall_signal_handlers();
  return true;
}

std::vector<std::string> init_and_remove_ros_arguments(int argc, char const* const* argv,
                                                       const InitOptions& init_options) {
  init(argc, argv, init_options);
  return remove_ros_arguments(argc, argv);
}

std::vector<std::string> remove_ros_arguments(const std::vector<std::string>& words) {
  std::vector<std::string> rest;
  bool inside = false;
  for (const auto& word : words) {
    if (!inside && word == "--ros-args") {
      inside = true;
    } else if (inside && word == "--") {
      inside = false;
    } else if (!inside) {
      rest.push_back(word);
    }
  }
  return rest;
}

std::vector<std::string> remove_ros_arguments(int argc, char const* const* argv) {
  if (argc <= 0 || !argv) return {};
  return remove_ros_arguments(std::vector<std::string>(argv, argv + argc));
}

bool ok(Context::SharedPtr context) { return or_default(context)->is_valid(); }
bool is_initialized(Context::SharedPtr context) { return ok(context); }

bool shutdown(Context::SharedPtr context, const std::string& reason) {
  const auto default_context = contexts::get_global_default_context();
  const auto which = context ? context : default_context;
  const bool done = which->shutdown(reason);
  if (which == default_context) {
    uninstall_signal_handlers();
    gazelle::request_shutdown(reason);
  }
  return done;
}

void on_shutdown(std::function<void()> callback, Context::SharedPtr context) {
  or_default(context)->on_shutdown(std::move(callback));
}

bool sleep_for(const std::chrono::nanoseconds& nanoseconds, Context::SharedPtr context) {
  return or_default(context)->sleep_for(nanoseconds);
}

std::vector<const char*> get_c_vector_string(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const auto& one : texts) pointers.push_back(one.c_str());
  return pointers;
}

namespace exceptions {

void throw_from_rcl_error(rcl_ret_t code, const std::string& prefix, const void*,
                          void (*reset_error)()) {
  const RCLErrorBase base(code, rcutils_get_error_string().str);
  if (reset_error) {
    reset_error();
  } else {
    rcutils_reset_error();
  }
  switch (code) {
    case RCL_RET_BAD_ALLOC:
      throw RCLBadAlloc(base);
    case RCL_RET_INVALID_ARGUMENT:
      throw RCLInvalidArgument(base, prefix);
    default:
      throw RCLError(base, prefix);
  }
}

}  // namespace exceptions
}  // namespace rclcpp
