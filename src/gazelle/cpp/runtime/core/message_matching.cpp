// Messages of several topics that belong together.

#include "gazelle/message_filters/matching.hpp"

#include <algorithm>
#include <utility>

namespace gazelle {

// ---- Equal stamps

void ExactMatcher::add(std::size_t topic, Stamped message) {
  Events& events = waiting_[message.stamp_ns];
  events.resize(topics_);
  events[topic] = std::move(message.event);
  const bool is_whole =
      std::all_of(events.begin(), events.end(), [](const auto& event) { return event != nullptr; });
  if (is_whole) {
    const Events found = std::move(events);
    const std::int64_t stamp_ns = message.stamp_ns;
    waiting_.erase(stamp_ns);
    drop_before(stamp_ns);
    matched_(found);
  }
  while (queue_size_ > 0 && waiting_.size() > queue_size_) drop(waiting_.begin());
}

void ExactMatcher::drop_before(std::int64_t stamp_ns) {
  while (!waiting_.empty() && waiting_.begin()->first <= stamp_ns) drop(waiting_.begin());
}

void ExactMatcher::drop(std::map<std::int64_t, Events>::iterator place) {
  const Events events = std::move(place->second);
  waiting_.erase(place);
  if (dropped_) dropped_(events);
}

// ---- Stamps near each other

ApproximateMatcher::ApproximateMatcher(std::size_t topics, std::size_t queue_size, Matched matched)
    : queue_size_(queue_size), matched_(std::move(matched)), topics_(topics) {}

void ApproximateMatcher::set_lower_bound(std::size_t topic, std::int64_t bound_ns) {
  if (topic < topics_.size()) topics_[topic].lower_bound_ns = bound_ns;
}

void ApproximateMatcher::add(std::size_t topic, Stamped message) {
  Topic& own = topics_[topic];
  own.ahead.push_back(std::move(message));
  if (own.ahead.size() == 1) {
    if (++with_messages_ == topics_.size()) process();
  } else {
    check_bound(topic);
  }
  if (own.ahead.size() + own.passed.size() <= queue_size_) return;
  // Too many: the search begins again without the oldest of this topic.
  bring_all_back();
  drop_front(topic);
  own.has_dropped = true;
  if (pivot_ != kNone) {
    best_.clear();
    pivot_ = kNone;
    process();
  }
}

void ApproximateMatcher::check_bound(std::size_t topic) {
  Topic& own = topics_[topic];
  if (own.was_warned || !broken_bound) return;
  const std::int64_t last = own.ahead.back().stamp_ns;
  const std::int64_t before = own.ahead[own.ahead.size() - 2].stamp_ns;
  if (last < before) {
    own.was_warned = true;
    broken_bound(topic, true);
  } else if (last - before < own.lower_bound_ns) {
    own.was_warned = true;
    broken_bound(topic, false);
  }
}

std::int64_t ApproximateMatcher::earliest_of(const Topic& topic, bool with_bounds) const {
  if (!topic.ahead.empty() || !with_bounds) return topic.ahead.front().stamp_ns;
  // What comes next cannot be older than the last one and its bound, nor matter before the pivot.
  return std::max(topic.passed.back().stamp_ns + topic.lower_bound_ns, pivot_ns_);
}

ApproximateMatcher::Edge ApproximateMatcher::edge(bool latest, bool with_bounds) const {
  Edge found{0, earliest_of(topics_[0], with_bounds)};
  for (std::size_t i = 1; i < topics_.size(); ++i) {
    const std::int64_t stamp_ns = earliest_of(topics_[i], with_bounds);
    if (latest ? stamp_ns > found.stamp_ns : stamp_ns < found.stamp_ns) found = {i, stamp_ns};
  }
  return found;
}

// Whether a set with these ends is no better than the best so far: what its end is later, with the
// penalty of age, outweighs what its start is later.
bool ApproximateMatcher::costs_more(std::int64_t end_ns, std::int64_t start_ns) const {
  return static_cast<double>(end_ns - best_end_ns_) * (1.0 + age_penalty) >=
         static_cast<double>(start_ns - best_start_ns_);
}

void ApproximateMatcher::process() {
  while (with_messages_ == topics_.size()) {
    const Edge end = edge(true, false);
    const Edge start = edge(false, false);
    // Dropped messages of the others were older than these: nothing was lost with them.
    for (std::size_t i = 0; i < topics_.size(); ++i)
      if (i != end.topic) topics_[i].has_dropped = false;
    if (pivot_ == kNone) {
      if (end.stamp_ns - start.stamp_ns > max_interval_ns || topics_[end.topic].has_dropped) {
        drop_front(start.topic);
        continue;
      }
      pivot_ = end.topic;
      pivot_ns_ = end.stamp_ns;
      choose();
      best_start_ns_ = start.stamp_ns;
      best_end_ns_ = end.stamp_ns;
    } else if (!costs_more(end.stamp_ns, start.stamp_ns)) {
      choose();
      best_start_ns_ = start.stamp_ns;
      best_end_ns_ = end.stamp_ns;
    }
    move_on(start.topic);
    if (start.topic == pivot_ || costs_more(end.stamp_ns, pivot_ns_)) {
      tell();
    } else if (with_messages_ < topics_.size()) {
      if (!try_with_bounds()) return;
    }
  }
}

// Suppose that what comes next comes as early as it may: true where the best is told for that.
bool ApproximateMatcher::try_with_bounds() {
  std::vector<std::size_t> moves(topics_.size(), 0);
  for (;;) {
    const Edge end = edge(true, true);
    const Edge start = edge(false, true);
    if (costs_more(end.stamp_ns, pivot_ns_)) {
      tell();
      return true;
    }
    if (!costs_more(end.stamp_ns, start.stamp_ns)) {
      for (std::size_t i = 0; i < topics_.size(); ++i) bring_back(i, moves[i]);
      return false;
    }
    move_on(start.topic);
    ++moves[start.topic];
  }
}

void ApproximateMatcher::choose() {
  best_.clear();
  for (Topic& topic : topics_) {
    best_.push_back(topic.ahead.front().event);
    topic.passed.clear();
  }
}

void ApproximateMatcher::tell() {
  const std::vector<std::shared_ptr<const void>> told = std::move(best_);
  best_.clear();
  pivot_ = kNone;
  bring_all_back();
  for (std::size_t i = 0; i < topics_.size(); ++i) drop_front(i);
  matched_(told);
}

void ApproximateMatcher::move_on(std::size_t topic) {
  Topic& own = topics_[topic];
  own.passed.push_back(std::move(own.ahead.front()));
  drop_front(topic);
}

void ApproximateMatcher::drop_front(std::size_t topic) {
  Topic& own = topics_[topic];
  own.ahead.pop_front();
  if (own.ahead.empty()) --with_messages_;
}

void ApproximateMatcher::bring_back(std::size_t topic, std::size_t count) {
  Topic& own = topics_[topic];
  if (count > 0 && own.ahead.empty()) ++with_messages_;
  for (; count > 0; --count) {
    own.ahead.push_front(std::move(own.passed.back()));
    own.passed.pop_back();
  }
}

void ApproximateMatcher::bring_all_back() {
  for (std::size_t i = 0; i < topics_.size(); ++i) bring_back(i, topics_[i].passed.size());
}

}  // namespace gazelle
