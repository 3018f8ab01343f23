// Threads that call callbacks.

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace ros {

namespace {

// A queue is called by one single-threaded spinner, or by spinners of several threads.
class Spinning {
 public:
  // False where somebody else has it already in a way that does not go together.
  bool begin(CallbackQueue* queue, bool is_single) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Entry& entry = entries_[queue];
    if (entry.count != 0 && (is_single || entry.single != std::thread::id()) &&
        !(is_single && entry.single == std::this_thread::get_id()))
      return false;
    if (is_single) entry.single = std::this_thread::get_id();
    ++entry.count;
    return true;
  }
  void end(CallbackQueue* queue) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = entries_.find(queue);
    if (found != entries_.end() && --found->second.count == 0) entries_.erase(found);
  }
  bool isFree(CallbackQueue* queue) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = entries_.find(queue);
    return found == entries_.end() || found->second.single == std::thread::id();
  }

 private:
  struct Entry {
    int count = 0;
    std::thread::id single;
  };
  std::mutex mutex_;
  std::map<CallbackQueue*, Entry> entries_;
};

Spinning& spinning() {
  static Spinning* const state = new Spinning;
  return *state;
}

// Signals are the main thread's.
class BlockedSignals {
 public:
  BlockedSignals() {
    // Only those that end or wake a program: what these threads start inherits the mask, and a
    // program without SIGCHLD waits for its children for ever.
    sigset_t blocked;
    sigemptyset(&blocked);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2})
      sigaddset(&blocked, number);
    pthread_sigmask(SIG_BLOCK, &blocked, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

uint32_t coresWhereNone(uint32_t count) {
  if (count != 0) return count;
  const uint32_t cores = std::thread::hardware_concurrency();
  return cores == 0 ? 1 : cores;
}

}  // namespace

void SingleThreadedSpinner::spin(CallbackQueue* queue) {
  if (!queue) queue = getGlobalCallbackQueue();
  if (!spinning().begin(queue, true)) {
    const char* const text =
        "SingleThreadedSpinner: Attempt to spin a callback queue from two spinners, one of them "
        "being single-threaded. You might want to use a MultiThreadedSpinner instead.";
    ROS_FATAL("%s", text);
    throw std::runtime_error(text);
  }
  struct End {
    CallbackQueue* queue;
    ~End() { spinning().end(queue); }
  } end{queue};
  while (ok()) queue->callAvailable(WallDuration(0.1));
}

MultiThreadedSpinner::MultiThreadedSpinner(uint32_t thread_count) : thread_count_(thread_count) {}

void MultiThreadedSpinner::spin(CallbackQueue* queue) {
  AsyncSpinner spinner(thread_count_, queue);
  spinner.start();
  waitForShutdown();
}

class AsyncSpinnerImpl {
 public:
  AsyncSpinnerImpl(uint32_t thread_count, CallbackQueue* queue)
      : thread_count_(coresWhereNone(thread_count)),
        queue_(queue ? queue : getGlobalCallbackQueue()) {}
  ~AsyncSpinnerImpl() { stop(); }

  bool canStart() { return spinning().isFree(queue_); }

  void start() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (continue_) return;
    if (!spinning().begin(queue_, false)) {
      const char* const text =
          "AsyncSpinnerImpl: Attempt to start() an AsyncSpinner failed because the callback queue "
          "is already spun by a SingleThreadedSpinner.";
      ROS_FATAL("%s", text);
      throw std::runtime_error(text);
    }
    continue_ = std::make_shared<std::atomic<bool> >(true);
    const BlockedSignals blocked;
    for (uint32_t i = 0; i < thread_count_; ++i)
      threads_.emplace_back([queue = queue_, keeps_on = continue_] {
        while (*keeps_on && ok()) queue->callAvailable(WallDuration(0.1));
      });
  }

  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!continue_) return;
    *continue_ = false;
    for (std::thread& thread : threads_) {
      if (thread.get_id() == std::this_thread::get_id())
        thread.detach();
      else
        thread.join();
    }
    threads_.clear();
    continue_.reset();
    spinning().end(queue_);
  }

 private:
  std::mutex mutex_;
  const uint32_t thread_count_;
  const NodeHandle node_;  // brings the node up, and keeps it so
  CallbackQueue* const queue_;
  std::vector<std::thread> threads_;
  std::shared_ptr<std::atomic<bool> > continue_;
};

AsyncSpinner::AsyncSpinner(uint32_t thread_count)
    : impl_(boost::make_shared<AsyncSpinnerImpl>(thread_count, static_cast<CallbackQueue*>(0))) {}
AsyncSpinner::AsyncSpinner(uint32_t thread_count, CallbackQueue* queue)
    : impl_(boost::make_shared<AsyncSpinnerImpl>(thread_count, queue)) {}
bool AsyncSpinner::canStart() { return impl_->canStart(); }
void AsyncSpinner::start() { impl_->start(); }
void AsyncSpinner::stop() { impl_->stop(); }

}  // namespace ros
