// The part of Boost.Thread that is not in its headers, for machines that have no more than those.
//
// Written against the declarations of Boost 1.74 to 1.8x. A thread keeps its record alive by
// `self` until it has ended; whoever joins it holds another reference.
#include <boost/thread/future.hpp>
#include <boost/thread/once.hpp>
#include <boost/thread/thread.hpp>
#include <boost/thread/tss.hpp>

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace boost {
namespace detail {

struct thread_exit_callback_node {
  thread_exit_function_base* function;
  thread_exit_callback_node* next;
};

namespace {

/// A thread that Boost did not start, and that has values of its own all the same.
struct ForeignThread : thread_data_base {
  void run() override {}
};

thread_local thread_data_base* current = nullptr;

void run_exit_callbacks(thread_data_base& thread) {
  // A callback may add another one, or a value.
  while (thread.thread_exit_callbacks != nullptr || !thread.tss_data.empty()) {
    while (thread_exit_callback_node* node = thread.thread_exit_callbacks) {
      thread.thread_exit_callbacks = node->next;
      if (node->function != nullptr) {
        (*node->function)();
        delete node->function;
      }
      delete node;
    }
    std::map<void const*, tss_data_node> values;
    values.swap(thread.tss_data);
    for (auto& entry : values) {
      if (entry.second.func != nullptr && entry.second.value != nullptr) {
        (*entry.second.caller)(entry.second.func, entry.second.value);
      }
    }
  }
}

/// Ends the record of a thread that Boost did not start when that thread ends.
struct ForeignEnd {
  thread_data_ptr record;

  ~ForeignEnd() {
    if (record) {
      run_exit_callbacks(*record);
      record->self.reset();
      current = nullptr;
    }
  }
};

thread_data_base& current_or_foreign() {
  if (current == nullptr) {
    static thread_local ForeignEnd end;
    end.record.reset(new ForeignThread);
    end.record->self = end.record;
    end.record->thread_handle = pthread_self();
    current = end.record.get();
  }
  return *current;
}

void tell_of_end(thread_data_base& thread) {
  {
    boost::lock_guard<boost::mutex> guard(thread.data_mutex);
    thread.done = true;
  }
  thread.done_condition.notify_all();
}

extern "C" void* gazelle_boost_thread_begin(void* argument) {
  // The starter has put the record into its own `self`, so it is there.
  thread_data_ptr thread = static_cast<thread_data_base*>(argument)->self;
  thread->self.reset();
  current = thread.get();
  try {
    thread->run();
  } catch (const thread_interrupted&) {
    // An interrupted thread has ended as it was asked to.
  }
  run_exit_callbacks(*thread);
  current = nullptr;
  tell_of_end(*thread);
  return nullptr;
}

}  // namespace

thread_data_base::~thread_data_base() {
  for (auto& waiting : notify) {
    waiting.second->unlock();
    waiting.first->notify_all();
  }
  for (auto& state : async_states_) {
    state->notify_deferred();
  }
}

thread_data_base* get_current_thread_data() { return current; }

void add_thread_exit_function(thread_exit_function_base* function) {
  thread_data_base& thread = current_or_foreign();
  thread.thread_exit_callbacks =
      new thread_exit_callback_node{function, thread.thread_exit_callbacks};
}

void make_ready_at_thread_exit(shared_ptr<shared_state_base> state) {
  current_or_foreign().make_ready_at_thread_exit(std::move(state));
}

void* get_tss_data(void const* key) {
  if (current == nullptr) {
    return nullptr;
  }
  const auto found = current->tss_data.find(key);
  return found == current->tss_data.end() ? nullptr : found->second.value;
}

void set_tss_data(void const* key, thread::cleanup_caller_t caller, thread::cleanup_func_t func,
                  void* value, bool cleanup_existing) {
  if (current == nullptr && value == nullptr) {
    return;
  }
  thread_data_base& record = current_or_foreign();
  const auto found = record.tss_data.find(key);
  if (found != record.tss_data.end()) {
    const tss_data_node old = found->second;
    record.tss_data.erase(found);
    if (cleanup_existing && old.func != nullptr && old.value != nullptr) {
      (*old.caller)(old.func, old.value);
    }
  }
  if (func != nullptr || value != nullptr) {
    record.tss_data.insert(std::make_pair(key, tss_data_node(caller, func, value)));
  }
}

}  // namespace detail

thread::thread() BOOST_NOEXCEPT {}

thread::thread(detail::thread_data_ptr data) : thread_info(std::move(data)) {}

bool thread::start_thread_noexcept() { return start_thread_noexcept(attributes()); }

bool thread::start_thread_noexcept(const attributes& wanted) {
  thread_info->self = thread_info;
  const pthread_attr_t* native = wanted.native_handle();
  if (pthread_create(&thread_info->thread_handle, native, &detail::gazelle_boost_thread_begin,
                     thread_info.get()) != 0) {
    thread_info->self.reset();
    return false;
  }
  int state = PTHREAD_CREATE_JOINABLE;
  pthread_attr_getdetachstate(native, &state);
  if (state == PTHREAD_CREATE_DETACHED) {
    boost::lock_guard<boost::mutex> guard(thread_info->data_mutex);
    thread_info->join_started = true;
    thread_info->joined = true;
  }
  return true;
}

detail::thread_data_ptr thread::get_thread_info BOOST_PREVENT_MACRO_SUBSTITUTION() const {
  return thread_info;
}

bool thread::joinable() const BOOST_NOEXCEPT { return static_cast<bool>(thread_info); }

bool thread::join_noexcept() {
  const detail::thread_data_ptr record = thread_info;
  if (!record) {
    return false;
  }
  bool is_mine = false;
  {
    boost::unique_lock<boost::mutex> lock(record->data_mutex);
    while (!record->done) {
      record->done_condition.wait(lock);
    }
    is_mine = !record->join_started;
    record->join_started = true;
    while (!is_mine && !record->joined) {
      record->done_condition.wait(lock);
    }
  }
  if (is_mine) {
    pthread_join(record->thread_handle, nullptr);
    boost::lock_guard<boost::mutex> guard(record->data_mutex);
    record->joined = true;
    record->done_condition.notify_all();
  }
  if (thread_info == record) {
    thread_info.reset();
  }
  return true;
}

bool thread::do_try_join_until_noexcept(detail::internal_platform_timepoint const& timeout,
                                        bool& result) {
  const detail::thread_data_ptr record = thread_info;
  if (!record) {
    return false;
  }
  {
    boost::unique_lock<boost::mutex> lock(record->data_mutex);
    while (!record->done) {
      if (!record->done_condition.do_wait_until(lock, timeout) && !record->done) {
        result = false;
        return true;
      }
    }
  }
  result = join_noexcept();
  return true;
}

void thread::detach() {
  detail::thread_data_ptr record;
  thread_info.swap(record);
  if (record) {
    boost::lock_guard<boost::mutex> guard(record->data_mutex);
    if (!record->join_started) {
      pthread_detach(record->thread_handle);
      record->join_started = true;
      record->joined = true;
    }
  }
}

unsigned thread::hardware_concurrency() BOOST_NOEXCEPT {
  return std::thread::hardware_concurrency();
}

unsigned thread::physical_concurrency() BOOST_NOEXCEPT {
  try {
    std::ifstream file("/proc/cpuinfo");
    std::set<std::pair<std::string, std::string>> cores;
    std::string line;
    std::string package;
    while (std::getline(file, line)) {
      const auto colon = line.find(':');
      if (line.compare(0, 11, "physical id") == 0 && colon != std::string::npos) {
        package = line.substr(colon);
      } else if (line.compare(0, 7, "core id") == 0 && colon != std::string::npos) {
        cores.emplace(package, line.substr(colon));
      }
    }
    if (!cores.empty()) {
      return static_cast<unsigned>(cores.size());
    }
  } catch (...) {
    // Then all that the system counts are taken for cores.
    return hardware_concurrency();
  }
  return hardware_concurrency();
}

thread::native_handle_type thread::native_handle() {
  const detail::thread_data_ptr record = thread_info;
  if (!record) {
    return native_handle_type();
  }
  boost::lock_guard<boost::mutex> guard(record->data_mutex);
  return record->thread_handle;
}

void thread::interrupt() {
  const detail::thread_data_ptr record = thread_info;
  if (!record) {
    return;
  }
  boost::lock_guard<boost::mutex> guard(record->data_mutex);
  record->interrupt_requested = true;
  if (record->current_cond != nullptr) {
    // It waits: under its mutex, so that it does not begin to just now.
    pthread_mutex_lock(record->cond_mutex);
    pthread_cond_broadcast(record->current_cond);
    pthread_mutex_unlock(record->cond_mutex);
  }
}

bool thread::interruption_requested() const BOOST_NOEXCEPT {
  const detail::thread_data_ptr record = thread_info;
  if (!record) {
    return false;
  }
  boost::lock_guard<boost::mutex> guard(record->data_mutex);
  return record->interrupt_requested;
}

namespace this_thread {

void interruption_point() {
  detail::thread_data_base* const record = detail::current;
  if (record != nullptr && record->interrupt_enabled) {
    boost::lock_guard<boost::mutex> guard(record->data_mutex);
    if (record->interrupt_requested) {
      record->interrupt_requested = false;
      throw thread_interrupted();
    }
  }
}

bool interruption_enabled() BOOST_NOEXCEPT {
  return detail::current != nullptr && detail::current->interrupt_enabled;
}

bool interruption_requested() BOOST_NOEXCEPT {
  detail::thread_data_base* const record = detail::current;
  if (record == nullptr) {
    return false;
  }
  boost::lock_guard<boost::mutex> guard(record->data_mutex);
  return record->interrupt_requested;
}

disable_interruption::disable_interruption() BOOST_NOEXCEPT
    : interruption_was_enabled(interruption_enabled()) {
  if (interruption_was_enabled) {
    detail::current->interrupt_enabled = false;
  }
}

disable_interruption::~disable_interruption() BOOST_NOEXCEPT {
  if (detail::current != nullptr) {
    detail::current->interrupt_enabled = interruption_was_enabled;
  }
}

restore_interruption::restore_interruption(disable_interruption& disabled) BOOST_NOEXCEPT {
  if (disabled.interruption_was_enabled) {
    detail::current->interrupt_enabled = true;
  }
}

restore_interruption::~restore_interruption() BOOST_NOEXCEPT {
  if (detail::current != nullptr) {
    detail::current->interrupt_enabled = false;
  }
}

void yield() BOOST_NOEXCEPT { sched_yield(); }

namespace no_interruption_point {
namespace hidden {

void sleep_for_internal(const detail::platform_duration& time) {
  if (time > detail::platform_duration::zero()) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(time.getNs()));
  }
}

}  // namespace hidden
}  // namespace no_interruption_point
}  // namespace this_thread

void notify_all_at_thread_exit(condition_variable& condition, unique_lock<mutex> lock) {
  detail::current_or_foreign().notify_all_at_thread_exit(&condition, lock.release());
}

namespace {

class FutureCategory : public system::error_category {
 public:
  const char* name() const BOOST_NOEXCEPT override { return "future"; }

  std::string message(int value) const override {
    switch (static_cast<future_errc>(value)) {
      case future_errc::broken_promise:
        return "The associated promise has been destructed prior to the associated state becoming "
               "ready.";
      case future_errc::future_already_retrieved:
        return "The future has already been retrieved from the promise or packaged_task.";
      case future_errc::promise_already_satisfied:
        return "The state of the promise has already been set.";
      case future_errc::no_state:
        return "Operation not permitted on an object without an associated state.";
      default:
        return "unspecified future_errc value";
    }
  }
};

}  // namespace

const system::error_category& future_category() BOOST_NOEXCEPT {
  static const FutureCategory category;
  return category;
}

namespace thread_detail {
namespace {

enum : atomic_int_type { untouched = 0, begun = 1, done = 2 };

pthread_mutex_t once_mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t once_changed = PTHREAD_COND_INITIALIZER;

void set_state(once_flag& flag, atomic_int_type state) {
  pthread_mutex_lock(&once_mutex);
  get_atomic_storage(flag).store(state, memory_order_release);
  pthread_mutex_unlock(&once_mutex);
  pthread_cond_broadcast(&once_changed);
}

}  // namespace

bool enter_once_region(once_flag& flag) BOOST_NOEXCEPT {
  atomic_type& state = get_atomic_storage(flag);
  if (state.load(memory_order_acquire) == done) {
    return false;
  }
  pthread_mutex_lock(&once_mutex);
  while (state.load(memory_order_acquire) == begun) {
    pthread_cond_wait(&once_changed, &once_mutex);
  }
  const bool is_first = state.load(memory_order_acquire) == untouched;
  if (is_first) {
    state.store(begun, memory_order_release);
  }
  pthread_mutex_unlock(&once_mutex);
  return is_first;
}

void commit_once_region(once_flag& flag) BOOST_NOEXCEPT { set_state(flag, done); }

void rollback_once_region(once_flag& flag) BOOST_NOEXCEPT { set_state(flag, untouched); }

}  // namespace thread_detail
}  // namespace boost
