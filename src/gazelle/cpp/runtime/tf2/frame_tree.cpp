#include "gazelle/frame_tree.hpp"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "frame_texts.hpp"

namespace gazelle {

namespace {

constexpr double norm_tolerance = 10e-3;

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

FoundTransform compose(const FoundTransform& outer, const FoundTransform& inner) {
  FoundTransform out;
  out.rotation = outer.rotation * inner.rotation;
  out.translation = tf2::quatRotate(outer.rotation, inner.translation) + outer.translation;
  return out;
}

FoundTransform inverse(const FoundTransform& transform) {
  FoundTransform out;
  out.rotation = transform.rotation.inverse();
  out.translation = -tf2::quatRotate(out.rotation, transform.translation);
  return out;
}

[[noreturn]] void raise(FrameFault fault, const std::string& why) {
  switch (fault) {
    case FrameFault::connectivity:
      throw tf2::ConnectivityException(why);
    case FrameFault::past:
      throw tf2::BackwardExtrapolationException(why);
    case FrameFault::future:
      throw tf2::ForwardExtrapolationException(why);
    case FrameFault::no_data:
      throw tf2::NoDataForExtrapolationException(why);
    case FrameFault::invalid:
      throw tf2::InvalidArgumentException(why);
    default:
      throw tf2::LookupException(why);
  }
}

}  // namespace

FrameTree::FrameTree(std::int64_t cache_ns, Words words) : cache_ns_(cache_ns), words_(words) {
  frames_.emplace_back();
  frames_.back().name = "NO_PARENT";
  numbers_["NO_PARENT"] = 0;
}

void FrameTree::on_warning(Warning warning) {
  std::lock_guard<std::mutex> hold(lock_);
  warning_ = std::move(warning);
}

void FrameTree::warn(const std::string& text) {
  Warning told;
  {
    std::lock_guard<std::mutex> hold(lock_);
    if (std::find(warned_.begin(), warned_.end(), text) != warned_.end()) return;
    if (warned_.size() >= 1000) warned_.clear();  // texts with times in them never repeat
    warned_.push_back(text);
    told = warning_;
  }
  if (told) {
    told(text);
  } else {
    std::fprintf(stderr, "Warning: %s\n", text.c_str());
  }
}

bool FrameTree::set(const std::string& frame, const std::string& child, std::int64_t stamp_ns,
                    const tf2::Vector3& translation, const tf2::Quaternion& rotation,
                    const std::string& authority, bool is_static) {
  const std::string parent_name = without_slash(frame), child_name = without_slash(child);
  const std::string problem = frame_texts::problem(parent_name, child_name, translation, rotation,
                                                   norm_tolerance, authority);
  if (!problem.empty()) {
    warn(problem);
    return false;
  }
  bool is_taken = false;
  {
    std::lock_guard<std::mutex> hold(lock_);
    const FrameId number = find_or_add(child_name);
    if (!frames_[number].has_parent()) frames_[number].is_static = is_static;
    FrameSample sample;
    sample.stamp_ns = stamp_ns;
    sample.rotation = rotation;
    sample.translation = translation;
    sample.parent = find_or_add(parent_name);
    is_taken = add(frames_[number], sample);
    if (is_taken) {
      frames_[number].authority = authority;
      ++changes_;
    }
  }
  if (!is_taken) return false;
  changed_.notify_all();
  answer_requests();
  std::vector<std::function<void()>> told;
  {
    std::lock_guard<std::mutex> hold(lock_);
    for (const auto& one : listeners_) told.push_back(one.second);
  }
  for (const auto& one : told) one();
  return true;
}

bool FrameTree::add(Frame& frame, const FrameSample& sample) {
  std::deque<FrameSample>& samples = frame.samples;
  if (frame.is_static) {
    samples.assign(1, sample);
    return true;
  }
  if (samples.empty() || sample.stamp_ns > samples.back().stamp_ns) {
    samples.push_back(sample);
  } else {
    if (sample.stamp_ns + cache_ns_ < samples.back().stamp_ns) return false;
    const auto place = std::lower_bound(
        samples.begin(), samples.end(), sample.stamp_ns,
        [](const FrameSample& one, std::int64_t stamp) { return one.stamp_ns < stamp; });
    if (place->stamp_ns == sample.stamp_ns) return false;
    samples.insert(place, sample);
  }
  const std::int64_t oldest = samples.back().stamp_ns - cache_ns_;
  while (samples.front().stamp_ns < oldest) samples.pop_front();
  return true;
}

void FrameTree::clear() {
  std::lock_guard<std::mutex> hold(lock_);
  for (Frame& frame : frames_) {
    if (!frame.is_static) frame.samples.clear();
  }
}

FrameId FrameTree::find(const std::string& frame) const {
  const auto found = numbers_.find(frame);
  return found == numbers_.end() ? 0 : found->second;
}

FrameId FrameTree::find_or_add(const std::string& frame) {
  const auto [place, is_new] = numbers_.emplace(frame, static_cast<FrameId>(frames_.size()));
  if (is_new) {
    frames_.emplace_back();
    frames_.back().name = frame;
  }
  return place->second;
}

FrameId FrameTree::check(const char* argument, const std::string& frame) const {
  const std::string wrong = frame_texts::illegal(argument, frame);
  if (!wrong.empty()) throw tf2::InvalidArgumentException(wrong);
  const FrameId found = find(frame);
  if (found != 0) return found;
  std::vector<std::string> known;
  for (std::size_t i = 1; i < frames_.size(); ++i) known.push_back(frames_[i].name);
  throw tf2::LookupException(frame_texts::unknown(argument, frame, known));
}

FrameFault FrameTree::at(const Frame& frame, std::int64_t stamp_ns, FrameSample& out,
                         std::string* why) const {
  const std::deque<FrameSample>& samples = frame.samples;
  if (frame.is_static || stamp_ns == 0) {
    out = samples.back();
    if (frame.is_static) out.stamp_ns = stamp_ns;
    return FrameFault::none;
  }
  const auto after = std::lower_bound(
      samples.begin(), samples.end(), stamp_ns,
      [](const FrameSample& one, std::int64_t stamp) { return one.stamp_ns < stamp; });
  if (after != samples.end() && after->stamp_ns == stamp_ns) {
    out = *after;
    return FrameFault::none;
  }
  if (after == samples.begin() || after == samples.end()) {
    if (why != nullptr)
      *why = frame_texts::outside(stamp_ns, samples.front().stamp_ns, samples.back().stamp_ns,
                                  samples.size());
    if (samples.size() == 1) return FrameFault::no_data;
    return after == samples.begin() ? FrameFault::past : FrameFault::future;
  }
  const FrameSample &before = *std::prev(after), &next = *after;
  out = before;
  if (before.parent == next.parent) {
    const double ratio = static_cast<double>(stamp_ns - before.stamp_ns) /
                         static_cast<double>(next.stamp_ns - before.stamp_ns);
    out.stamp_ns = stamp_ns;
    out.translation.setInterpolate3(before.translation, next.translation, ratio);
    out.rotation = before.rotation.slerp(next.rotation, ratio);
  }
  return FrameFault::none;
}

FrameFault FrameTree::ancestors(FrameId frame, std::vector<FrameId>& out, std::string* why) const {
  out.assign(1, frame);
  while (frames_[out.back()].has_parent()) {
    if (out.size() > max_depth) {
      if (why != nullptr) *why = frame_texts::loop + text_locked();
      return FrameFault::lookup;
    }
    out.push_back(frames_[out.back()].samples.back().parent);
  }
  return FrameFault::none;
}

FrameFault FrameTree::common_time(FrameId target, FrameId source, std::int64_t& stamp_ns,
                                  std::string* why) const {
  stamp_ns = 0;
  if (target == source) {
    if (frames_[target].has_parent()) stamp_ns = frames_[target].newest_ns();
    return FrameFault::none;
  }
  std::vector<FrameId> up, down;
  FrameFault fault = ancestors(source, up, why);
  if (fault == FrameFault::none) fault = ancestors(target, down, why);
  if (fault != FrameFault::none) return fault;
  std::size_t in_up = 0, in_down = 0;
  for (; in_up < up.size(); ++in_up) {
    const auto meeting = std::find(down.begin(), down.end(), up[in_up]);
    if (meeting != down.end()) {
      in_down = static_cast<std::size_t>(meeting - down.begin());
      break;
    }
  }
  if (in_up == up.size()) {
    if (why != nullptr) *why = unconnected(target, source);
    return FrameFault::connectivity;
  }
  up.resize(in_up);
  up.insert(up.end(), down.begin(), down.begin() + static_cast<std::ptrdiff_t>(in_down));
  for (const FrameId one : up) {
    const std::int64_t newest = frames_[one].newest_ns();
    if (newest != 0 && (stamp_ns == 0 || newest < stamp_ns)) stamp_ns = newest;
  }
  return FrameFault::none;
}

// Up from the source to the target or the root, then up from the target until the ways meet.
FrameFault FrameTree::walk(FrameId target, FrameId source, std::int64_t stamp_ns,
                           FoundTransform* out, std::vector<FrameId>* through,
                           std::string* why) const {
  struct Step {
    FrameId frame;
    FoundTransform from_start;
  };
  std::vector<Step> up;
  FrameFault fault = FrameFault::none;
  std::string outside;
  const auto climb = [&](Step& here) {
    const Frame& frame = frames_[here.frame];
    FrameSample sample;
    if (!frame.has_parent()) return false;
    const FrameFault problem = at(frame, stamp_ns, sample, why == nullptr ? nullptr : &outside);
    if (problem != FrameFault::none) {
      fault = problem;
      return false;
    }
    FoundTransform edge;
    edge.rotation = sample.rotation;
    edge.translation = sample.translation;
    here = Step{sample.parent, compose(edge, here.from_start)};
    return true;
  };
  Step here{source, {}};
  do {
    up.push_back(here);
  } while (here.frame != target && up.size() <= max_depth && climb(here));
  here = Step{target, {}};
  std::vector<FrameId> down;
  do {
    const auto meeting = std::find_if(up.begin(), up.end(),
                                      [&](const Step& one) { return one.frame == here.frame; });
    if (meeting != up.end()) {
      if (out != nullptr) {
        *out = compose(inverse(here.from_start), meeting->from_start);
        out->stamp_ns = stamp_ns;
      }
      if (through != nullptr) {
        for (auto one = up.begin(); one != std::next(meeting); ++one)
          through->push_back(one->frame);
        through->insert(through->end(), down.rbegin(), down.rend());
      }
      return FrameFault::none;
    }
    down.push_back(here.frame);
  } while (down.size() <= max_depth && climb(here));
  if (fault == FrameFault::none) {
    std::vector<FrameId> way;
    fault = ancestors(source, way, why);
    if (fault == FrameFault::none) fault = ancestors(target, way, why);
    if (fault != FrameFault::none) return fault;
    if (why != nullptr) *why = unconnected(target, source);
    return FrameFault::connectivity;
  }
  if (why != nullptr)
    *why = outside + ", when looking up transform from frame [" + frames_[source].name +
           "] to frame [" + frames_[target].name + "]";
  return fault;
}

FoundTransform FrameTree::look_up_locked(FrameId target, FrameId source,
                                         std::int64_t stamp_ns) const {
  FoundTransform out;
  std::string why;
  std::int64_t common_ns = 0;
  if (target == source) {
    common_time(target, source, common_ns, nullptr);
    out.stamp_ns = stamp_ns == 0 ? common_ns : stamp_ns;
    return out;
  }
  FrameFault fault = common_time(target, source, common_ns, &why);
  if (fault != FrameFault::none) raise(fault, why);
  fault = walk(target, source, stamp_ns == 0 ? common_ns : stamp_ns, &out, nullptr, &why);
  if (fault != FrameFault::none) raise(fault, why);
  return out;
}

FoundTransform FrameTree::look_up(const std::string& target, const std::string& source,
                                  std::int64_t stamp_ns) const {
  std::lock_guard<std::mutex> hold(lock_);
  const FrameId to = check("lookupTransform argument target_frame", target);
  const FrameId from = check("lookupTransform argument source_frame", source);
  return look_up_locked(to, from, stamp_ns);
}

FoundTransform FrameTree::look_up(const std::string& target, std::int64_t target_ns,
                                  const std::string& source, std::int64_t source_ns,
                                  const std::string& fixed) const {
  std::lock_guard<std::mutex> hold(lock_);
  const FrameId to = check("lookupTransform argument target_frame", target);
  const FrameId from = check("lookupTransform argument source_frame", source);
  const FrameId still = check("lookupTransform argument fixed_frame", fixed);
  const FoundTransform first = look_up_locked(still, from, source_ns);
  const FoundTransform second = look_up_locked(to, still, target_ns);
  FoundTransform out = compose(second, first);
  out.stamp_ns = second.stamp_ns;
  return out;
}

bool FrameTree::can_locked(FrameId target, FrameId source, std::int64_t stamp_ns,
                           std::string* why) const {
  if (target == source) return true;
  if (stamp_ns == 0 && common_time(target, source, stamp_ns, why) != FrameFault::none) return false;
  return walk(target, source, stamp_ns, nullptr, nullptr, why) == FrameFault::none;
}

bool FrameTree::known(const char* argument, const std::string& frame, std::string* why) const {
  if (frame_texts::illegal(argument, frame).empty() && find(frame) != 0) return true;
  if (why != nullptr) {
    const std::string text = words_ == Words::ros1 ? frame_texts::cannot_ros1(argument, frame)
                                                   : frame_texts::cannot_ros2(argument, frame);
    *why += (why->empty() ? "" : " ") + text;
  }
  return false;
}

bool FrameTree::can(const std::string& target, const std::string& source, std::int64_t stamp_ns,
                    std::string* why) const {
  std::lock_guard<std::mutex> hold(lock_);
  std::string text;
  const bool both = known("target_frame", target, &text) & known("source_frame", source, &text);
  const bool is_there =
      both && can_locked(find(target), find(source), stamp_ns, why == nullptr ? nullptr : &text);
  if (!is_there && why != nullptr) *why = text;
  return is_there;
}

bool FrameTree::can(const std::string& target, std::int64_t target_ns, const std::string& source,
                    std::int64_t source_ns, const std::string& fixed, std::string* why) const {
  std::lock_guard<std::mutex> hold(lock_);
  std::string text;
  bool is_there = known("target_frame", target, &text) & known("source_frame", source, &text) &
                  known("fixed_frame", fixed, &text);
  std::string* told = why == nullptr ? nullptr : &text;
  is_there = is_there && can_locked(find(fixed), find(source), source_ns, told) &&
             can_locked(find(target), find(fixed), target_ns, told);
  if (!is_there && why != nullptr) *why = text;
  return is_there;
}

std::uint64_t FrameTree::request(const std::string& target, const std::string& source,
                                 std::int64_t stamp_ns, Waiting done) {
  std::lock_guard<std::mutex> hold(lock_);
  if (target == source) return 0;
  const FrameId to = find(target), from = find(source);
  if (to != 0 && from != 0) {
    std::int64_t newest = 0;
    if (common_time(to, from, newest, nullptr) == FrameFault::none && newest != 0 &&
        stamp_ns != 0 && stamp_ns + cache_ns_ < newest)
      return never;
    if (can_locked(to, from, stamp_ns, nullptr)) return 0;
  }
  requests_.push_back(Request{++last_handle_, target, source, stamp_ns, std::move(done)});
  return last_handle_;
}

void FrameTree::cancel(std::uint64_t handle) {
  std::lock_guard<std::mutex> hold(lock_);
  requests_.erase(std::remove_if(requests_.begin(), requests_.end(),
                                 [&](const Request& one) { return one.handle == handle; }),
                  requests_.end());
}

void FrameTree::answer_requests() {
  std::vector<std::pair<Request, bool>> answered;
  {
    std::lock_guard<std::mutex> hold(lock_);
    if (requests_.empty()) return;
    std::vector<Request> left;
    for (Request& one : requests_) {
      const FrameId to = find(one.target), from = find(one.source);
      std::int64_t newest = 0;
      const bool is_connected =
          to != 0 && from != 0 && common_time(to, from, newest, nullptr) == FrameFault::none;
      if (is_connected && can_locked(to, from, one.stamp_ns, nullptr)) {
        answered.emplace_back(std::move(one), true);
      } else if (is_connected && newest != 0 && one.stamp_ns != 0 &&
                 one.stamp_ns + cache_ns_ < newest) {
        answered.emplace_back(std::move(one), false);
      } else {
        left.push_back(std::move(one));
      }
    }
    requests_ = std::move(left);
  }
  for (const auto& [one, is_available] : answered) one.done(one.handle, is_available);
}

bool FrameTree::wait_for_change(std::int64_t timeout_ns) const {
  std::unique_lock<std::mutex> hold(lock_);
  const std::uint64_t before = changes_;
  return changed_.wait_for(hold, std::chrono::nanoseconds(timeout_ns),
                           [&] { return changes_ != before; });
}

std::uint64_t FrameTree::add_listener(std::function<void()> listener) {
  std::lock_guard<std::mutex> hold(lock_);
  listeners_.emplace_back(++last_listener_, std::move(listener));
  return last_listener_;
}

void FrameTree::remove_listener(std::uint64_t number) {
  std::lock_guard<std::mutex> hold(lock_);
  listeners_.erase(std::remove_if(listeners_.begin(), listeners_.end(),
                                  [&](const auto& one) { return one.first == number; }),
                   listeners_.end());
}

bool FrameTree::exists(const std::string& frame) const {
  std::lock_guard<std::mutex> hold(lock_);
  return find(frame) != 0;
}

bool FrameTree::parent(const std::string& frame, std::int64_t stamp_ns, std::string& out) const {
  std::lock_guard<std::mutex> hold(lock_);
  const FrameId number = find(frame);
  FrameSample sample;
  if (number == 0 || !frames_[number].has_parent() ||
      at(frames_[number], stamp_ns, sample, nullptr) != FrameFault::none)
    return false;
  out = frames_[sample.parent].name;
  return true;
}

std::vector<std::string> FrameTree::names() const {
  std::lock_guard<std::mutex> hold(lock_);
  std::vector<std::string> out;
  for (std::size_t i = 1; i < frames_.size(); ++i) out.push_back(frames_[i].name);
  return out;
}

FrameId FrameTree::number(const std::string& frame) const {
  std::lock_guard<std::mutex> hold(lock_);
  return find(frame);
}

FrameId FrameTree::number_or_new(const std::string& frame) {
  std::lock_guard<std::mutex> hold(lock_);
  return find_or_add(frame);
}

const std::string& FrameTree::name(FrameId number) const {
  std::lock_guard<std::mutex> hold(lock_);
  if (number >= frames_.size())
    throw tf2::LookupException("Reverse lookup of frame id " + std::to_string(number) + " failed!");
  return frames_[number].name;
}

FrameId FrameTree::checked_number(const char* argument, const std::string& frame) const {
  std::lock_guard<std::mutex> hold(lock_);
  return check(argument, frame);
}

FrameFault FrameTree::latest_common_time(FrameId target, FrameId source, std::int64_t& stamp_ns,
                                         std::string* why) const {
  std::lock_guard<std::mutex> hold(lock_);
  if (target == 0 || source == 0 || target >= frames_.size() || source >= frames_.size()) {
    if (why != nullptr) *why = "a frame does not exist";
    return FrameFault::lookup;
  }
  return common_time(target, source, stamp_ns, why);
}

std::vector<std::string> FrameTree::chain(const std::string& target, std::int64_t target_ns,
                                          const std::string& source, std::int64_t source_ns,
                                          const std::string& fixed) const {
  std::lock_guard<std::mutex> hold(lock_);
  const FrameId to = check("lookupTransform argument target_frame", target);
  const FrameId from = check("lookupTransform argument source_frame", source);
  const FrameId still = check("lookupTransform argument fixed_frame", fixed);
  std::vector<FrameId> through;
  const auto follow = [&](FrameId upper, FrameId lower, std::int64_t stamp_ns) {
    std::string why;
    std::int64_t common_ns = 0;
    FrameFault fault = common_time(upper, lower, common_ns, &why);
    if (fault == FrameFault::none)
      fault = walk(upper, lower, stamp_ns == 0 ? common_ns : stamp_ns, nullptr, &through, &why);
    if (fault != FrameFault::none) raise(fault, why);
  };
  follow(still, from, source_ns);
  if (still != to) {
    through.pop_back();  // the second way begins where the first ends
    follow(to, still, target_ns);
  }
  std::vector<std::string> out;
  for (const FrameId one : through) {
    if (out.empty() || out.back() != frames_[one].name) out.push_back(frames_[one].name);
  }
  return out;
}

std::string FrameTree::unconnected(FrameId target, FrameId source) const {
  std::vector<FrameId> up, down;
  ancestors(source, up, nullptr);
  ancestors(target, down, nullptr);
  return frame_texts::unconnected(frames_[target].name, frames_[source].name,
                                  frames_[down.back()].name, frames_[up.back()].name);
}

double FrameTree::rate(const Frame& frame) const {
  const double length_s = static_cast<double>(frame.newest_ns() - frame.oldest_ns()) / 1e9;
  return static_cast<double>(frame.samples.size()) / std::max(length_s, 1e-4);
}

std::string FrameTree::text_locked() const {
  std::string out;
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    if (frames_[i].has_parent())
      out += "Frame " + frames_[i].name + " exists with parent " +
             frames_[frames_[i].samples.back().parent].name + ".\n";
  }
  return out;
}

std::string FrameTree::as_text() const {
  std::lock_guard<std::mutex> hold(lock_);
  return text_locked();
}

std::string FrameTree::as_yaml(double now_s) const {
  std::lock_guard<std::mutex> hold(lock_);
  std::string out;
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    const Frame& frame = frames_[i];
    if (!frame.has_parent()) continue;
    const double newest = static_cast<double>(frame.newest_ns()) / 1e9;
    const double oldest = static_cast<double>(frame.oldest_ns()) / 1e9;
    out += frame_texts::yaml(frame.name, frames_[frame.samples.back().parent].name, frame.authority,
                             rate(frame), newest, oldest, now_s);
  }
  return out.empty() ? "{}" : out;
}

std::string FrameTree::as_dot(double now_s) const {
  std::lock_guard<std::mutex> hold(lock_);
  std::string out;
  std::vector<std::string> roots;
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    const Frame& frame = frames_[i];
    if (!frame.has_parent()) continue;
    const Frame& parent = frames_[frame.samples.back().parent];
    out += frame_texts::dot_edge(frame.name, parent.name, frame.authority, rate(frame),
                                 static_cast<double>(frame.newest_ns()) / 1e9,
                                 static_cast<double>(frame.oldest_ns()) / 1e9, now_s);
    if (!parent.has_parent() && std::find(roots.begin(), roots.end(), parent.name) == roots.end())
      roots.push_back(parent.name);
  }
  return frame_texts::dot_graph(out, roots, now_s);
}

}  // namespace gazelle
