// Executors: what is ready, in which order, in which threads.
#include "rclcpp/executor.hpp"

#include <algorithm>
#include <deque>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "gazelle/core.hpp"
#include "rclcpp/executors.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node.hpp"

namespace rclcpp {

using Nanoseconds = std::chrono::nanoseconds;
using Steady = std::chrono::steady_clock;
using NodeBase = node_interfaces::NodeBaseInterface;

// Futures that other threads fulfil are looked at so often at least.
static constexpr Nanoseconds kLookAtFutures = std::chrono::milliseconds(100);

class Executor::Impl {
 public:
  struct Member {
    std::weak_ptr<detail::Executable> work;
    std::weak_ptr<CallbackGroup> group;
    std::weak_ptr<NodeBase> node;
    detail::WorkKind kind;
  };
  struct Group {
    std::weak_ptr<CallbackGroup> group;
    std::weak_ptr<NodeBase> node;
  };

  std::shared_ptr<detail::Waker> waker = std::make_shared<detail::Waker>();
  std::mutex mutex;  // of everything below
  std::vector<std::weak_ptr<NodeBase>> nodes;
  std::vector<Group> manual, automatic;
  std::vector<Member> members;
  std::uint64_t version = 0;
  std::deque<Member> ready;
  std::atomic<bool> cancelled{false};
  OnShutdownCallbackHandle shutdown_handle;

  void take_in(const Group& group, std::vector<Member>& found) {
    const auto strong = group.group.lock();
    if (!strong) return;
    for (const auto& one : strong->executables()) {
      one->add_waker(waker);
      found.push_back({one, group.group, group.node, one->kind()});
    }
  }

  // Called with the lock held.
  void collect() {
    const std::uint64_t now = detail::entities_version();
    if (now == version) return;
    version = now;
    adopt_groups();
    std::vector<Member> found;
    for (const auto& one : manual) take_in(one, found);
    for (const auto& one : automatic) take_in(one, found);
    std::stable_sort(found.begin(), found.end(), [](const Member& a, const Member& b) {
      return static_cast<int>(a.kind) < static_cast<int>(b.kind);
    });
    members = std::move(found);
  }

  // Groups that nodes made since.
  void adopt_groups() {
    const auto gone = [](const Group& one) { return one.group.expired() || one.node.expired(); };
    manual.erase(std::remove_if(manual.begin(), manual.end(), gone), manual.end());
    automatic.erase(std::remove_if(automatic.begin(), automatic.end(), gone), automatic.end());
    for (const auto& weak : nodes) {
      const auto node = weak.lock();
      if (!node) continue;
      node->for_each_callback_group([&](CallbackGroup::SharedPtr group) {
        if (!group->automatically_add_to_executor_with_node()) return;
        if (group->get_associated_with_executor_atomic().exchange(true)) return;
        group->add_waker(waker);
        automatic.push_back({group, node});
      });
    }
  }

  /// Note what is ready now; tell how long it takes until a timer is.
  std::optional<Nanoseconds> look() {
    std::lock_guard<std::mutex> lock(mutex);
    collect();
    std::optional<Nanoseconds> until;
    for (const auto& one : members) {
      const auto group = one.group.lock();
      if (!group || !group->can_be_taken_from().load()) continue;
      const auto work = one.work.lock();
      if (!work) continue;
      if (work->has_work()) {
        ready.push_back(one);
      } else if (const auto wait = work->time_until_work()) {
        until = until ? std::min(*until, *wait) : *wait;
      }
    }
    return until;
  }

  bool is_anything_ready() {
    std::lock_guard<std::mutex> lock(mutex);
    return !ready.empty();
  }
};

AnyExecutable::~AnyExecutable() {
  // What was taken and not executed frees its group.
  if (callback_group && callback_group->type() == CallbackGroupType::MutuallyExclusive) {
    callback_group->can_be_taken_from().store(true);
  }
}

Executor::Executor(const ExecutorOptions& options)
    : context_(options.context), impl_(std::make_unique<Impl>()) {
  std::weak_ptr<detail::Waker> weak = impl_->waker;
  impl_->shutdown_handle = context_->add_on_shutdown_callback([weak]() {
    if (const auto strong = weak.lock()) strong->ring();
  });
}

Executor::~Executor() {
  context_->remove_on_shutdown_callback(impl_->shutdown_handle);
  std::lock_guard<std::mutex> lock(impl_->mutex);
  for (const auto* groups : {&impl_->manual, &impl_->automatic}) {
    for (const auto& one : *groups) {
      if (const auto group = one.group.lock()) {
        group->remove_waker(impl_->waker.get());
        group->get_associated_with_executor_atomic().store(false);
      }
    }
  }
  for (const auto& weak : impl_->nodes) {
    if (const auto node = weak.lock()) {
      node->remove_waker(impl_->waker.get());
      node->get_associated_with_executor_atomic().store(false);
    }
  }
}

bool Executor::has_context() const { return context_ && context_->is_valid(); }

void Executor::add_callback_group(CallbackGroup::SharedPtr group, NodeBase::SharedPtr node,
                                  bool notify) {
  if (group->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error("Callback group has already been added to an executor.");
  }
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    group->add_waker(impl_->waker);
    impl_->manual.push_back({group, node});
  }
  detail::entities_changed();
  if (notify) impl_->waker->ring();
}

void Executor::remove_callback_group(CallbackGroup::SharedPtr group, bool notify) {
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    bool found = false;
    for (auto* groups : {&impl_->manual, &impl_->automatic}) {
      const auto end = std::remove_if(groups->begin(), groups->end(), [&group](const auto& one) {
        return one.group.lock() == group;
      });
      found = found || end != groups->end();
      groups->erase(end, groups->end());
    }
    if (!found) throw std::runtime_error("Callback group needs to be associated with executor.");
    group->remove_waker(impl_->waker.get());
    group->get_associated_with_executor_atomic().store(false);
  }
  detail::entities_changed();
  if (notify) impl_->waker->ring();
}

std::vector<CallbackGroup::WeakPtr> Executor::get_manually_added_callback_groups() {
  std::vector<CallbackGroup::WeakPtr> groups;
  std::lock_guard<std::mutex> lock(impl_->mutex);
  for (const auto& one : impl_->manual) groups.push_back(one.group);
  return groups;
}

std::vector<CallbackGroup::WeakPtr> Executor::get_automatically_added_callback_groups_from_nodes() {
  std::vector<CallbackGroup::WeakPtr> groups;
  std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->adopt_groups();
  for (const auto& one : impl_->automatic) groups.push_back(one.group);
  return groups;
}

std::vector<CallbackGroup::WeakPtr> Executor::get_all_callback_groups() {
  auto groups = get_manually_added_callback_groups();
  const auto more = get_automatically_added_callback_groups_from_nodes();
  groups.insert(groups.end(), more.begin(), more.end());
  return groups;
}

void Executor::add_node(NodeBase::SharedPtr node, bool notify) {
  if (node->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error(std::string("Node '") + node->get_fully_qualified_name() +
                             "' has already been added to an executor.");
  }
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->nodes.push_back(node);
    node->add_waker(impl_->waker);
  }
  detail::entities_changed();
  if (notify) impl_->waker->ring();
}

void Executor::add_node(std::shared_ptr<Node> node, bool notify) {
  add_node(node->get_node_base_interface(), notify);
}

void Executor::remove_node(NodeBase::SharedPtr node, bool notify) {
  if (!node->get_associated_with_executor_atomic().load()) {
    throw std::runtime_error(std::string("Node '") + node->get_fully_qualified_name() +
                             "' needs to be associated with an executor.");
  }
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    auto& nodes = impl_->nodes;
    const auto end = std::remove_if(nodes.begin(), nodes.end(),
                                    [&node](const auto& one) { return one.lock() == node; });
    if (end == nodes.end()) {
      throw std::runtime_error(std::string("Node '") + node->get_fully_qualified_name() +
                               "' needs to be associated with this executor.");
    }
    nodes.erase(end, nodes.end());
    auto& groups = impl_->automatic;
    for (const auto& one : groups) {
      if (one.node.lock() != node) continue;
      if (const auto group = one.group.lock()) {
        group->remove_waker(impl_->waker.get());
        for (const auto& work : group->executables()) work->remove_waker(impl_->waker.get());
        group->get_associated_with_executor_atomic().store(false);
      }
    }
    groups.erase(std::remove_if(groups.begin(), groups.end(),
                                [&node](const auto& one) { return one.node.lock() == node; }),
                 groups.end());
    auto& ready = impl_->ready;
    ready.erase(std::remove_if(ready.begin(), ready.end(),
                               [&node](const auto& one) { return one.node.lock() == node; }),
                ready.end());
    node->remove_waker(impl_->waker.get());
    node->get_associated_with_executor_atomic().store(false);
  }
  detail::entities_changed();
  if (notify) impl_->waker->ring();
}

void Executor::remove_node(std::shared_ptr<Node> node, bool notify) {
  remove_node(node->get_node_base_interface(), notify);
}

void Executor::spin_node_once_nanoseconds(NodeBase::SharedPtr node, Nanoseconds timeout) {
  add_node(node, false);
  try {
    spin_once(timeout);
  } catch (...) {
    remove_node(node, false);
    throw;
  }
  remove_node(node, false);
}

void Executor::spin_node_some(NodeBase::SharedPtr node) {
  add_node(node, false);
  try {
    spin_some();
  } catch (...) {
    remove_node(node, false);
    throw;
  }
  remove_node(node, false);
}

void Executor::spin_node_some(std::shared_ptr<Node> node) {
  spin_node_some(node->get_node_base_interface());
}

void Executor::spin_node_all(NodeBase::SharedPtr node, Nanoseconds max_duration) {
  add_node(node, false);
  try {
    spin_all(max_duration);
  } catch (...) {
    remove_node(node, false);
    throw;
  }
  remove_node(node, false);
}

std::shared_ptr<void> Executor::begin_spinning(const char* function) {
  if (spinning.exchange(true)) {
    throw std::runtime_error(std::string(function) + "() called while already spinning");
  }
  impl_->cancelled = false;
  return std::shared_ptr<void>(nullptr, [this](void*) { spinning.store(false); });
}

void Executor::spin_some(Nanoseconds max_duration) { spin_some_impl(max_duration, false); }

void Executor::spin_all(Nanoseconds max_duration) {
  if (max_duration < Nanoseconds(0)) {
    throw std::invalid_argument("max_duration must be greater than or equal to 0");
  }
  spin_some_impl(max_duration, true);
}

void Executor::spin_some_impl(Nanoseconds max_duration, bool exhaustive) {
  const auto begin = Steady::now();
  const auto in_time = [&]() {
    return max_duration == Nanoseconds(0) || Steady::now() - begin < max_duration;
  };
  const auto guard = begin_spinning("spin_some");
  bool looked = false;
  bool did_something = false;
  while (has_context() && spinning.load() && in_time()) {
    if (!looked) {
      wait_for_work(Nanoseconds(0));
      looked = true;
      did_something = false;
    }
    AnyExecutable next;
    if (get_next_ready_executable(next)) {
      execute_any_executable(next);
      did_something = true;
    } else if (exhaustive && did_something) {
      looked = false;
    } else {
      break;
    }
  }
}

void Executor::spin_once_impl(Nanoseconds timeout) {
  AnyExecutable next;
  if (get_next_executable(next, timeout)) execute_any_executable(next);
}

void Executor::spin_once(Nanoseconds timeout) {
  const auto guard = begin_spinning("spin_once");
  spin_once_impl(timeout);
}

FutureReturnCode Executor::spin_until_future_complete_impl(Nanoseconds timeout,
                                                           const std::function<bool()>& is_ready) {
  if (is_ready()) return FutureReturnCode::SUCCESS;
  const bool endless = timeout < Nanoseconds(0);
  const auto end = Steady::now() + (endless ? Nanoseconds(0) : timeout);
  if (timeout > Nanoseconds(0) || endless) {
    const auto guard = begin_spinning("spin_until_future_complete");
    while (has_context() && spinning.load()) {
      Nanoseconds left = kLookAtFutures;
      if (!endless) {
        left = std::min(left, std::chrono::duration_cast<Nanoseconds>(end - Steady::now()));
      }
      spin_once_impl(std::max(left, Nanoseconds(0)));
      if (is_ready()) return FutureReturnCode::SUCCESS;
      if (!endless && Steady::now() >= end) return FutureReturnCode::TIMEOUT;
    }
    return FutureReturnCode::INTERRUPTED;
  }
  spin_once(Nanoseconds(0));
  return is_ready() ? FutureReturnCode::SUCCESS : FutureReturnCode::TIMEOUT;
}

void Executor::cancel() {
  spinning.store(false);
  impl_->cancelled = true;
  impl_->waker->ring();
}

void Executor::execute_any_executable(AnyExecutable& executable) {
  if (!executable.work) return;
  if (spinning.load()) executable.work->do_work();
  if (executable.callback_group &&
      executable.callback_group->type() == CallbackGroupType::MutuallyExclusive) {
    executable.callback_group->can_be_taken_from().store(true);
    // What else the group has may be ready since; who waits has to look again.
    impl_->waker->ring();
  }
  executable.callback_group.reset();
}

void Executor::wait_for_work(Nanoseconds timeout) {
  const bool endless = timeout < Nanoseconds(0);
  const auto end = Steady::now() + (endless ? Nanoseconds(0) : timeout);
  for (;;) {
    const std::uint64_t seen = impl_->waker->count();
    const auto timer = impl_->look();
    if (impl_->is_anything_ready() || !has_context() || !spinning.load()) return;
    const auto now = Steady::now();
    if (!endless && now >= end) return;
    std::optional<Steady::time_point> until;
    if (!endless) until = end;
    if (timer && (!until || now + *timer < *until)) until = now + *timer;
    impl_->waker->wait(seen, until);
    if (!has_context() || !spinning.load()) return;
  }
}

bool Executor::get_next_ready_executable(AnyExecutable& executable) {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  auto& ready = impl_->ready;
  for (auto one = ready.begin(); one != ready.end();) {
    const auto work = one->work.lock();
    const auto group = one->group.lock();
    const auto node = one->node.lock();
    if (!work || !group || !node) {
      one = ready.erase(one);
      continue;
    }
    if (group->type() == CallbackGroupType::MutuallyExclusive) {
      bool free = true;
      if (!group->can_be_taken_from().compare_exchange_strong(free, false)) {
        // The group is busy in another thread: the next look finds the work again.
        one = ready.erase(one);
        continue;
      }
    }
    executable.work = work;
    executable.callback_group = group;
    executable.node_base = node;
    switch (one->kind) {
      case detail::WorkKind::kTimer:
        executable.timer = std::static_pointer_cast<TimerBase>(work);
        break;
      case detail::WorkKind::kSubscription:
        executable.subscription = std::static_pointer_cast<SubscriptionBase>(work);
        break;
      case detail::WorkKind::kService:
        executable.service = std::static_pointer_cast<ServiceBase>(work);
        break;
      case detail::WorkKind::kClient:
        executable.client = std::static_pointer_cast<ClientBase>(work);
        break;
      default:
        executable.waitable = std::dynamic_pointer_cast<Waitable>(work);
    }
    ready.erase(one);
    return true;
  }
  return false;
}

bool Executor::get_next_executable(AnyExecutable& executable, Nanoseconds timeout) {
  if (get_next_ready_executable(executable)) return true;
  wait_for_work(timeout);
  if (!spinning.load()) return false;
  return get_next_ready_executable(executable);
}

// ---- The kinds ----------------------------------------------------------------------------------

namespace executors {

void SingleThreadedExecutor::spin() {
  const auto guard = begin_spinning("spin");
  while (has_context() && spinning.load()) {
    AnyExecutable next;
    if (get_next_executable(next)) execute_any_executable(next);
  }
}

MultiThreadedExecutor::MultiThreadedExecutor(const ExecutorOptions& options,
                                             std::size_t number_of_threads,
                                             bool yield_before_execute, Nanoseconds timeout)
    : Executor(options),
      number_of_threads_(number_of_threads
                             ? number_of_threads
                             : std::max<std::size_t>(std::thread::hardware_concurrency(), 2)),
      yield_before_execute_(yield_before_execute),
      timeout_(timeout) {}

void MultiThreadedExecutor::spin() {
  const auto guard = begin_spinning("spin");
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&]() {
    try {
      run();
    } catch (...) {
      {
        std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
      }
      cancel();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < number_of_threads_; ++i) threads.emplace_back(work);
  work();
  for (auto& one : threads) one.join();
  if (failure) std::rethrow_exception(failure);
}

void MultiThreadedExecutor::run() {
  while (has_context() && spinning.load()) {
    AnyExecutable next;
    {
      std::lock_guard<std::mutex> lock(wait_mutex_);
      if (!has_context() || !spinning.load()) return;
      if (!get_next_executable(next, timeout_)) continue;
    }
    if (yield_before_execute_) std::this_thread::yield();
    execute_any_executable(next);
  }
}

}  // namespace executors

std::string to_string(const FutureReturnCode& code) {
  switch (code) {
    case FutureReturnCode::SUCCESS:
      return "SUCCESS (0)";
    case FutureReturnCode::INTERRUPTED:
      return "INTERRUPTED (1)";
    case FutureReturnCode::TIMEOUT:
      return "TIMEOUT (2)";
  }
  return "Unknown enum value (" + std::to_string(static_cast<int>(code)) + ")";
}

std::ostream& operator<<(std::ostream& out, const FutureReturnCode& code) {
  return out << to_string(code);
}

void spin_all(NodeBase::SharedPtr node, Nanoseconds max_duration) {
  executors::SingleThreadedExecutor executor;
  executor.spin_node_all(node, max_duration);
}
void spin_all(Node::SharedPtr node, Nanoseconds max_duration) {
  spin_all(node->get_node_base_interface(), max_duration);
}
void spin_some(NodeBase::SharedPtr node) {
  executors::SingleThreadedExecutor executor;
  executor.spin_node_some(node);
}
void spin_some(Node::SharedPtr node) { spin_some(node->get_node_base_interface()); }
void spin(NodeBase::SharedPtr node) {
  executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.spin();
  executor.remove_node(node);
}
void spin(Node::SharedPtr node) { spin(node->get_node_base_interface()); }

}  // namespace rclcpp
