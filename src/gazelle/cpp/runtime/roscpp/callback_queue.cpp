// The queue of callbacks.

#include <ros/callback_queue.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace ros {

namespace {

// What this thread is calling now, innermost last: an owner that takes itself out inside of its
// own callback must not wait for itself.
thread_local std::vector<std::pair<const void*, uint64_t> > being_called;

}  // namespace

struct CallbackQueue::State {
  struct Item {
    CallbackInterfacePtr callback;
    uint64_t owner;
    uint64_t number;
  };

  std::mutex mutex;
  std::condition_variable changed;  // something was added, is done, or the queue was switched
  std::deque<Item> items;
  std::unordered_map<uint64_t, int> running;
  uint64_t next_number = 1;
  bool is_enabled = true;
  int waiting = 0;

  bool hasReady(uint64_t last) const {
    return std::any_of(items.begin(), items.end(), [last](const Item& item) {
      return item.number <= last && item.callback->ready();
    });
  }

  // Takes out and calls the first that is ready, of those up to a number.
  CallOneResult callFirst(std::unique_lock<std::mutex>& lock, uint64_t last) {
    if (!is_enabled) return Disabled;
    if (items.empty()) return Empty;
    const auto found = std::find_if(items.begin(), items.end(), [last](const Item& item) {
      return item.number <= last && item.callback->ready();
    });
    if (found == items.end()) return CallOneResult::TryAgain;
    Item item = *found;
    items.erase(found);
    ++running[item.owner];
    lock.unlock();

    CallbackInterface::CallResult result = CallbackInterface::Invalid;
    struct Frame {  // an exception of the callback leaves everything in order
      State& state;
      std::unique_lock<std::mutex>& lock;
      Item& item;
      CallbackInterface::CallResult& result;
      ~Frame() {
        CallbackInterfacePtr again;
        if (result == CallbackInterface::TryAgain) again = item.callback;
        // What a callback holds may end with it, and take itself and others out of the queue: not
        // under the lock, and while it counts as being called here.
        item.callback.reset();
        being_called.pop_back();
        lock.lock();
        const auto count = state.running.find(item.owner);
        if (--count->second == 0) state.running.erase(count);
        if (again && state.is_enabled)
          state.items.push_back({again, item.owner, state.next_number++});
        if (state.waiting) state.changed.notify_all();
      }
    };
    {
      being_called.emplace_back(this, item.owner);
      Frame frame{*this, lock, item, result};
      result = item.callback->call();
    }
    return result == CallbackInterface::TryAgain ? CallOneResult::TryAgain : Called;
  }

  // Until something can be called, time is up or the queue is switched off.
  void wait(std::unique_lock<std::mutex>& lock, const WallDuration& timeout) {
    if (timeout.toNSec() <= 0 || hasReady(UINT64_MAX)) return;
    ++waiting;
    changed.wait_for(lock, std::chrono::nanoseconds(timeout.toNSec()),
                     [this] { return !is_enabled || hasReady(UINT64_MAX); });
    --waiting;
  }
};

CallbackQueue::CallbackQueue(bool enabled) : state_(std::make_shared<State>()) {
  state_->is_enabled = enabled;
}

CallbackQueue::~CallbackQueue() { disable(); }

void CallbackQueue::addCallback(const CallbackInterfacePtr& callback, uint64_t removal_id) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (!state_->is_enabled) return;
  state_->items.push_back({callback, removal_id, state_->next_number++});
  if (state_->waiting) state_->changed.notify_one();
}

void CallbackQueue::removeByID(uint64_t removal_id) {
  const std::shared_ptr<State> state = state_;
  std::deque<State::Item> removed;  // ends without the lock
  std::unique_lock<std::mutex> lock(state->mutex);
  for (auto item = state->items.begin(); item != state->items.end();) {
    if (item->owner == removal_id) {
      removed.push_back(*item);
      item = state->items.erase(item);
    } else {
      ++item;
    }
  }
  const int own = static_cast<int>(
      std::count(being_called.begin(), being_called.end(),
                 std::make_pair(static_cast<const void*>(state.get()), removal_id)));
  ++state->waiting;
  state->changed.wait(lock, [&] {
    const auto count = state->running.find(removal_id);
    return own > 0 || count == state->running.end();
  });
  --state->waiting;
}

CallbackQueue::CallOneResult CallbackQueue::callOne(WallDuration timeout) {
  const std::shared_ptr<State> state = state_;
  std::unique_lock<std::mutex> lock(state->mutex);
  if (!state->is_enabled) return Disabled;
  state->wait(lock, timeout);
  return state->callFirst(lock, UINT64_MAX);
}

void CallbackQueue::callAvailable(WallDuration timeout) {
  const std::shared_ptr<State> state = state_;
  std::unique_lock<std::mutex> lock(state->mutex);
  if (!state->is_enabled) return;
  state->wait(lock, timeout);
  const uint64_t last = state->next_number - 1;
  while (!state->items.empty() && state->items.front().number <= last) {
    const CallOneResult result = state->callFirst(lock, last);
    if (result != Called && result != CallOneResult::TryAgain) return;
    if (result == CallOneResult::TryAgain && !state->hasReady(last)) return;
  }
}

bool CallbackQueue::isEmpty() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->items.empty() && state_->running.empty();
}

void CallbackQueue::clear() {
  std::deque<State::Item> removed;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  removed.swap(state_->items);
}

void CallbackQueue::enable() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->is_enabled = true;
  state_->changed.notify_all();
}

void CallbackQueue::disable() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->is_enabled = false;
  state_->changed.notify_all();
}

bool CallbackQueue::isEnabled() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->is_enabled;
}

}  // namespace ros
