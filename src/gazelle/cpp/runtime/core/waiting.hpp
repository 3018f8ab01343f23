// One lock and one signal for all that waits in this process: for a time, for the end.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>

namespace gazelle {

struct Waiting {
  std::mutex mutex;
  std::condition_variable changed;
  std::condition_variable alarms;  // of the one thread that serves all timers
  // The simulated times that somebody waits for: who brings the time wakes nobody too early.
  std::multiset<std::int64_t> targets;
};

Waiting& waiting();

// Let everybody look again, the thread of the timers included.
void wake_all();

// Reckons how long to wait for a simulated time that is shown on a page, in wall nanoseconds.
// One for each who waits.
class PageWait {
 public:
  std::int64_t next_ns(std::int64_t now_ns, std::int64_t target_ns);

 private:
  std::int64_t before_ns_ = -1;
  int still_ = 0;
};

// How often time has jumped, as far as it has been told.
std::uint64_t told_jumps();

// Whether simulated time is looked up on a page just now.
bool is_clock_on_page();

// What a page has shown since last asked: true where it went back (listeners have been told).
void look_at_clock();

// A sleep of such a length begins: most are too short for a page where this says so.
void note_sleep(std::int64_t left_ns);

}  // namespace gazelle
