// Work at points in time: one thread for all timers of the process.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <thread>
#include <unordered_map>

#include "gazelle/core.hpp"
#include "host.hpp"
#include "waiting.hpp"

namespace gazelle {

namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;

using Function = std::function<void(clock::Wake)>;
using Due = std::multimap<std::int64_t, std::pair<std::uint64_t, Function>>;

struct Thread {
  std::mutex mutex;  // of the maps; taken after that of `waiting`, never before it
  Due due[3];
  std::unordered_map<std::uint64_t, std::pair<int, Due::iterator>> places;
  std::uint64_t last = 0;
  std::uint64_t jumps = 0;
  bool started = false;
};

Thread& the_thread() {
  static auto* one = new Thread;
  return *one;
}

std::int64_t now_of(int base) {
  switch (static_cast<Alarms::Base>(base)) {
    case Alarms::Base::kClock:
      return clock::now_ns();
    case Alarms::Base::kWall:
      return clock::wall_ns();
    default:
      return clock::steady_ns();
  }
}

// Take out what is due; `left` becomes how long the others have, in wall nanoseconds.
std::vector<std::pair<Function, clock::Wake>> take_due(PageWait& page_wait, std::int64_t& left,
                                                       std::int64_t& target) {
  Thread& all = the_thread();
  std::vector<std::pair<Function, clock::Wake>> found;
  left = kHourNs;
  target = -1;
  const bool on_page = is_clock_on_page();
  const std::uint64_t jumps = told_jumps();
  std::lock_guard lock(all.mutex);
  const bool has_jumped = jumps != all.jumps;
  all.jumps = jumps;
  for (int base = 0; base < 3; ++base) {
    Due& due = all.due[base];
    const bool is_clock = base == static_cast<int>(Alarms::Base::kClock);
    if (due.empty()) continue;
    const std::int64_t now = now_of(base);
    while (!due.empty()) {
      const auto first = due.begin();
      const bool is_reached = first->first <= now;
      if (!is_reached && !(is_clock && has_jumped)) break;
      found.emplace_back(std::move(first->second.second),
                         is_reached ? clock::Wake::kReached : clock::Wake::kJumped);
      all.places.erase(first->second.first);
      due.erase(first);
    }
    if (due.empty()) continue;
    const std::int64_t next = due.begin()->first;
    if (!is_clock || !clock::uses_sim_time()) {
      left = std::min(left, next - now);
    } else if (on_page) {
      left = std::min(left, page_wait.next_ns(now, next));
    } else {
      target = next;
    }
  }
  return found;
}

void run() {
  Waiting& all = waiting();
  PageWait page_wait;
  while (true) {
    std::int64_t left = 0;
    std::int64_t target = -1;
    if (is_clock_on_page()) look_at_clock();
    for (auto& one : take_due(page_wait, left, target)) one.first(one.second);
    std::unique_lock lock(all.mutex);
    // Once more, with the lock: what was added meanwhile has told nobody who waits.
    auto due = take_due(page_wait, left, target);
    if (due.empty()) {
      const auto mine = target >= 0 ? all.targets.insert(target) : all.targets.end();
      all.alarms.wait_for(lock, std::chrono::nanoseconds(std::max<std::int64_t>(left, 0)));
      if (target >= 0) all.targets.erase(mine);
      continue;
    }
    lock.unlock();
    for (auto& one : due) one.first(one.second);
  }
}

void start() {
  host::SignalsBlocked quiet;
  the_thread().jumps = told_jumps();
  std::thread(run).detach();
}

}  // namespace

std::uint64_t Alarms::at(Base base, std::int64_t when_ns,
                         std::function<void(clock::Wake)> function) {
  Thread& all = the_thread();
  std::uint64_t number;
  bool is_first;
  {
    std::lock_guard lock(all.mutex);
    if (!all.started) {
      all.started = true;
      start();
    }
    number = ++all.last;
    Due& due = all.due[static_cast<int>(base)];
    const auto place = due.emplace(when_ns, std::make_pair(number, std::move(function)));
    all.places[number] = {static_cast<int>(base), place};
    is_first = place == due.begin();
  }
  if (is_first) {
    { std::lock_guard lock(waiting().mutex); }
    waiting().alarms.notify_all();
  }
  return number;
}

bool Alarms::cancel(std::uint64_t number) {
  Thread& all = the_thread();
  std::lock_guard lock(all.mutex);
  const auto found = all.places.find(number);
  if (found == all.places.end()) return false;
  all.due[found->second.first].erase(found->second.second);
  all.places.erase(found);
  return true;
}

}  // namespace gazelle
