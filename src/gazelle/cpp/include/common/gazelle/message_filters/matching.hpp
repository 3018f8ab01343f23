// Which messages of several topics belong together: the engine of message_filters, without types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace gazelle {

// A message and its stamp.
struct Stamped {
  std::int64_t stamp_ns = 0;
  std::shared_ptr<const void> event;
};

using Matched = std::function<void(const std::vector<std::shared_ptr<const void>>&)>;

// One message a topic, all of the very same stamp. What is older than a match is dropped.
class __attribute__((visibility("default"))) ExactMatcher {
 public:
  ExactMatcher(std::size_t topics, std::size_t queue_size, Matched matched)
      : topics_(topics), queue_size_(queue_size), matched_(std::move(matched)) {}
  void on_drop(Matched dropped) { dropped_ = std::move(dropped); }
  void add(std::size_t topic, Stamped message);

 private:
  using Events = std::vector<std::shared_ptr<const void>>;
  void drop_before(std::int64_t stamp_ns);
  void drop(std::map<std::int64_t, Events>::iterator place);

  std::size_t topics_, queue_size_;
  Matched matched_, dropped_;
  std::map<std::int64_t, Events> waiting_;
};

// One message a topic, as near in time as can be: sets do not share messages and keep their order,
// and a set is told as soon as nothing that may still come could make a better one around its
// pivot, the latest of the earliest messages (the algorithm of message_filters' ApproximateTime).
class __attribute__((visibility("default"))) ApproximateMatcher {
 public:
  ApproximateMatcher(std::size_t topics, std::size_t queue_size, Matched matched);

  double age_penalty = 0.1;
  std::int64_t max_interval_ns = INT64_MAX;
  // The least time between two messages of a topic, where it is known: sets are told earlier.
  void set_lower_bound(std::size_t topic, std::int64_t bound_ns);
  // Told once a topic that does not keep its bound, or whose stamps go back.
  std::function<void(std::size_t topic, bool goes_back)> broken_bound;

  void add(std::size_t topic, Stamped message);

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Topic {
    std::deque<Stamped> ahead;    // may become part of a set
    std::vector<Stamped> passed;  // looked at already for the pivot of now
    bool has_dropped = false;     // older ones are gone: a set with it at its end may not be best
    bool was_warned = false;
    std::int64_t lower_bound_ns = 0;
  };
  struct Edge {
    std::size_t topic;
    std::int64_t stamp_ns;
  };

  void process();
  bool try_with_bounds();
  void choose();
  void tell();
  void move_on(std::size_t topic);
  void drop_front(std::size_t topic);
  void bring_back(std::size_t topic, std::size_t count);
  void bring_all_back();
  void check_bound(std::size_t topic);
  std::int64_t earliest_of(const Topic& topic, bool with_bounds) const;
  Edge edge(bool latest, bool with_bounds) const;
  bool costs_more(std::int64_t end_ns, std::int64_t start_ns) const;

  std::size_t queue_size_;
  Matched matched_;
  std::vector<Topic> topics_;
  std::size_t with_messages_ = 0;  // topics that have some ahead
  std::vector<std::shared_ptr<const void>> best_;
  std::int64_t best_start_ns_ = 0, best_end_ns_ = 0;
  std::size_t pivot_ = kNone;
  std::int64_t pivot_ns_ = 0;
};

}  // namespace gazelle
