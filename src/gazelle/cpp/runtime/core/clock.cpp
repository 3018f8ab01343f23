// Time: of the wall, or simulated, told by the host message by message or shown on a page.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>

#include "gazelle/core.hpp"
#include "host.hpp"
#include "listeners.hpp"
#include "waiting.hpp"

namespace gazelle {

namespace {

constexpr std::int64_t kMs = 1'000'000;
// How the page's number of jumps goes into its check (gazelle.graph.shared_memory_clock).
constexpr int kJumpBits = 40;
constexpr int kTries = 8;
// Looking early costs a look, looking late makes late.
constexpr std::int64_t kLeastWaitNs = kMs / 2;
constexpr std::int64_t kMostWaitNs = 100 * kMs;
constexpr std::int64_t kNearNs = 40 * kMs;
constexpr std::int64_t kRateWindowNs = 100 * kMs;
constexpr double kMostRate = 100.0;
// A simulator takes some steps at a time: shorter sleeps miss their end on a page.
constexpr std::int64_t kShortNs = 2'500'000;
constexpr int kManySleeps = 200;
constexpr std::int64_t kStillWaitsNs[] = {kMs / 2, kMs, 2 * kMs, 4 * kMs};
constexpr int kStillLooks = 28;
constexpr std::int64_t kLongStillNs = 50 * kMs;

struct Reading {
  std::int64_t now_ns = 0;
  std::int64_t jumps = 0;
  std::int64_t jump_ns = 0;
};

struct Clock {
  std::atomic<bool> is_simulated{false};
  std::atomic<const std::int64_t*> page{nullptr};
  std::atomic<std::int64_t> told_ns{0};
  std::atomic<std::uint64_t> jumps{0};
  // Held while a page's jump is taken in, and while what the host tells is.
  std::mutex taking;
  std::int64_t page_jumps = 0;
  Listeners<const clock::Jump&> on_jump;
  Listeners<std::int64_t> on_time;

  std::mutex rate_mutex;
  double rates[2] = {1.0, 1.0};
  std::int64_t mark_ns = 0;
  std::int64_t mark_wall_ns = 0;

  int short_sleeps = 0;
  bool mostly_short = false;
};

Clock& the_clock() {
  static auto* one = new Clock;
  return *one;
}

std::int64_t nanoseconds_of(clockid_t which) {
  timespec now;
  clock_gettime(which, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

// Written by another process at any time: each number is read at once, and the last one tells
// whether they fit together.
bool read_page(const std::int64_t* page, Reading& reading) {
  const auto* numbers = reinterpret_cast<const std::atomic<std::int64_t>*>(page);
  for (int i = 0; i < kTries; ++i) {
    reading.now_ns = numbers[0].load(std::memory_order_acquire);
    reading.jumps = numbers[1].load(std::memory_order_acquire);
    reading.jump_ns = numbers[2].load(std::memory_order_acquire);
    const std::int64_t check = numbers[3].load(std::memory_order_acquire);
    const auto shifted =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(reading.jumps) << kJumpBits);
    if (check == ~(reading.now_ns ^ shifted ^ reading.jump_ns)) return true;
  }
  return false;
}

void tell_jump(const clock::Jump& jump) {
  Clock& all = the_clock();
  all.jumps.fetch_add(1);
  wake_all();
  all.on_jump.tell(jump);
}

// Take in a jump that a page shows, once for everybody.
void take_jump(const Reading& reading) {
  Clock& all = the_clock();
  {
    std::lock_guard lock(all.taking);
    if (reading.jumps == all.page_jumps || all.page.load() == nullptr) return;
    all.page_jumps = reading.jumps;
    all.told_ns = reading.now_ns;
  }
  tell_jump({false, reading.jump_ns});
}

void note_rate(std::int64_t now_ns) {
  Clock& all = the_clock();
  const std::int64_t wall = clock::steady_ns();
  std::lock_guard lock(all.rate_mutex);
  const std::int64_t since = wall - all.mark_wall_ns;
  if (since < kRateWindowNs) return;
  const double rate = static_cast<double>(now_ns - all.mark_ns) / static_cast<double>(since);
  all.rates[0] = all.rates[1];
  all.rates[1] = std::clamp(rate, 1.0, kMostRate);
  all.mark_ns = now_ns;
  all.mark_wall_ns = wall;
}

}  // namespace

Waiting& waiting() {
  static auto* one = new Waiting;
  return *one;
}

void wake_all() {
  { std::lock_guard lock(waiting().mutex); }
  waiting().changed.notify_all();
  waiting().alarms.notify_all();
}

std::uint64_t told_jumps() { return the_clock().jumps.load(); }

bool is_clock_on_page() {
  return the_clock().is_simulated.load() && the_clock().page.load() != nullptr;
}

void look_at_clock() {
  Reading reading;
  const std::int64_t* page = the_clock().page.load();
  if (page == nullptr || !read_page(page, reading)) return;
  if (reading.jumps != the_clock().page_jumps) take_jump(reading);
}

void note_sleep(std::int64_t left_ns) {
  Clock& all = the_clock();
  bool changed = false;
  bool mostly_short = false;
  {
    std::lock_guard lock(all.rate_mutex);
    all.short_sleeps += left_ns < kShortNs ? 1 : -1;
    all.short_sleeps = std::clamp(all.short_sleeps, 0, kManySleeps);
    mostly_short = all.short_sleeps == kManySleeps || (all.mostly_short && all.short_sleeps != 0);
    changed = mostly_short != all.mostly_short;
    all.mostly_short = mostly_short;
  }
  if (changed) call("clock/prefer", Json::object({{"messages", mostly_short}}));
}

std::int64_t PageWait::next_ns(std::int64_t now_ns, std::int64_t target_ns) {
  note_rate(now_ns);
  still_ = now_ns == before_ns_ ? still_ + 1 : 0;
  before_ns_ = now_ns;
  if (still_ > kStillLooks) return kLongStillNs;
  if (still_ > 0) return kStillWaitsNs[std::min(still_, 4) - 1];
  double rate;
  {
    std::lock_guard lock(the_clock().rate_mutex);
    rate = std::max(the_clock().rates[0], the_clock().rates[1]);
  }
  auto left = static_cast<std::int64_t>(static_cast<double>(target_ns - now_ns) / rate);
  // What is far off is met by halves: time may come to run faster meanwhile.
  if (left > kNearNs) left = std::min(left / 2, kMostWaitNs);
  return std::max(left, kLeastWaitNs);
}

namespace clock {

std::int64_t wall_ns() { return nanoseconds_of(CLOCK_REALTIME); }

std::int64_t steady_ns() { return nanoseconds_of(CLOCK_MONOTONIC); }

bool uses_sim_time() { return the_clock().is_simulated.load(std::memory_order_relaxed); }

std::int64_t now_ns() {
  Clock& all = the_clock();
  if (!all.is_simulated.load(std::memory_order_acquire)) return wall_ns();
  const std::int64_t* page = all.page.load(std::memory_order_acquire);
  if (page == nullptr) return all.told_ns.load(std::memory_order_acquire);
  Reading reading;
  if (!read_page(page, reading)) return all.told_ns.load(std::memory_order_acquire);
  all.told_ns.store(reading.now_ns, std::memory_order_release);
  return reading.now_ns;
}

bool is_valid() { return !uses_sim_time() || now_ns() != 0; }

std::uint64_t jumps() {
  if (is_clock_on_page()) look_at_clock();
  return the_clock().jumps.load();
}

void use_sim_time(int choice) {
  Json value;
  if (choice >= 0) value = choice != 0;
  call("clock/use", Json::object({{"sim_time", value}}));
}

Wake wait_until(std::int64_t target_ns, const Stop& stop) {
  Waiting& all = waiting();
  const std::uint64_t jumps_before = jumps();
  PageWait page_wait;
  if (is_clock_on_page() && target_ns > now_ns()) note_sleep(target_ns - now_ns());
  while (true) {
    if (is_clock_on_page()) look_at_clock();
    std::unique_lock lock(all.mutex);
    if (the_clock().jumps.load() != jumps_before) return Wake::kJumped;
    const std::int64_t now = now_ns();
    if (now >= target_ns) return Wake::kReached;
    if (!ok() || (stop && stop())) return Wake::kStopped;
    if (!uses_sim_time()) {
      const std::int64_t left = std::min<std::int64_t>(target_ns - now, 3'600'000 * kMs);
      all.changed.wait_for(lock, std::chrono::nanoseconds(left));
    } else if (is_clock_on_page()) {
      all.changed.wait_for(lock, std::chrono::nanoseconds(page_wait.next_ns(now, target_ns)));
    } else {
      const auto mine = all.targets.insert(target_ns);
      all.changed.wait(lock);
      all.targets.erase(mine);
    }
  }
}

Wake wait_wall(std::int64_t duration_ns, const Stop& stop) {
  Waiting& all = waiting();
  const std::int64_t end = steady_ns() + std::max<std::int64_t>(duration_ns, 0);
  std::unique_lock lock(all.mutex);
  while (true) {
    const std::int64_t left = end - steady_ns();
    if (left <= 0) return Wake::kReached;
    if (!ok() || (stop && stop())) return Wake::kStopped;
    all.changed.wait_for(lock, std::chrono::nanoseconds(std::min(left, 3'600'000 * kMs)));
  }
}

void notify_waiters() { wake_all(); }

std::uint64_t on_jump(std::function<void(const Jump&)> listener) {
  return the_clock().on_jump.add(std::move(listener)) << 1;
}

std::uint64_t on_time(std::function<void(std::int64_t)> listener) {
  return the_clock().on_time.add(std::move(listener)) << 1 | 1;
}

void remove_listener(std::uint64_t number) {
  if ((number & 1) != 0) {
    the_clock().on_time.remove(number >> 1);
  } else {
    the_clock().on_jump.remove(number >> 1);
  }
}

}  // namespace clock

}  // namespace gazelle

extern "C" GAZELLE_EXPORT void gazelle_on_clock(int use_sim_time, const std::int64_t* page,
                                                std::int64_t now_ns, std::int64_t jump_ns) {
  using namespace gazelle;  // NOLINT: the whole of it is ours
  Clock& all = the_clock();
  bool switched = false;
  bool jumped = false;
  std::int64_t delta = jump_ns;
  {
    std::lock_guard lock(all.taking);
    const bool was_simulated = all.is_simulated.load();
    const std::int64_t before = was_simulated ? all.told_ns.load() : clock::wall_ns();
    switched = was_simulated != (use_sim_time != 0);
    if (page != nullptr && page != all.page.load()) {
      Reading reading;
      if (read_page(page, reading)) {
        all.page_jumps = reading.jumps;
        now_ns = reading.now_ns;
      }
    }
    if (use_sim_time != 0) all.told_ns = now_ns;
    all.page = page;
    all.is_simulated = use_sim_time != 0;
    if (switched) delta = clock::now_ns() - before;
    jumped = jump_ns < 0;
  }
  if (page != nullptr) look_at_clock();
  if (switched || jumped) {
    tell_jump({switched, delta});
  } else {
    bool is_due = page != nullptr;
    {
      std::lock_guard lock(waiting().mutex);
      const auto& targets = waiting().targets;
      is_due = is_due || (!targets.empty() && *targets.begin() <= now_ns);
    }
    if (is_due) wake_all();
  }
  if (use_sim_time != 0) all.on_time.tell(now_ns);
}
