// The tree of coordinate frames over the last seconds, and transforms between any two of them.
// What tf and tf2 of both ROSes are made of; the same rules and texts as gazelle.graph.tf.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "tf2/LinearMath/Transform.h"
#include "tf2/exceptions.h"

namespace gazelle {

using FrameId = std::uint32_t;  // 0: no frame

// Where a frame was at a time, seen from its parent.
struct FrameSample {
  std::int64_t stamp_ns = 0;
  FrameId parent = 0;
  tf2::Quaternion rotation{0.0, 0.0, 0.0, 1.0};
  tf2::Vector3 translation{0.0, 0.0, 0.0};
};

// Coordinates in the source frame become coordinates in the target frame.
struct FoundTransform {
  std::int64_t stamp_ns = 0;
  tf2::Quaternion rotation{0.0, 0.0, 0.0, 1.0};
  tf2::Vector3 translation{0.0, 0.0, 0.0};
};

enum class FrameFault { none, lookup, connectivity, past, future, no_data, invalid };

// Safe to use from many threads; functions given to it are called with no lock held.
class __attribute__((visibility("default"))) FrameTree {
 public:
  static constexpr std::size_t max_depth = 1000;
  static constexpr std::uint64_t never = 0xffffffffffffffffULL;

  enum class Words { ros1, ros2 };  // how a missing frame is told by `can`
  using Waiting = std::function<void(std::uint64_t handle, bool is_available)>;
  using Warning = std::function<void(const std::string& text)>;

  explicit FrameTree(std::int64_t cache_ns, Words words = Words::ros1);

  std::int64_t cache_ns() const { return cache_ns_; }
  // What is wrong with transforms that come in, each text once; without it, standard error.
  void on_warning(Warning warning);

  // False where the transform was not taken.
  bool set(const std::string& frame, const std::string& child, std::int64_t stamp_ns,
           const tf2::Vector3& translation, const tf2::Quaternion& rotation,
           const std::string& authority, bool is_static);
  // Forgets what moves, as after a jump of time.
  void clear();

  // Time 0 asks for the latest that all frames in between know. Throw tf2's exceptions.
  FoundTransform look_up(const std::string& target, const std::string& source,
                         std::int64_t stamp_ns) const;
  FoundTransform look_up(const std::string& target, std::int64_t target_ns,
                         const std::string& source, std::int64_t source_ns,
                         const std::string& fixed) const;
  bool can(const std::string& target, const std::string& source, std::int64_t stamp_ns,
           std::string* why) const;
  bool can(const std::string& target, std::int64_t target_ns, const std::string& source,
           std::int64_t source_ns, const std::string& fixed, std::string* why) const;

  // Calls once when the transform comes (true) or is out of reach (false). 0: it is there already,
  // `never`: it is too old; then nothing is called.
  std::uint64_t request(const std::string& target, const std::string& source, std::int64_t stamp_ns,
                        Waiting done);
  void cancel(std::uint64_t handle);
  // Waits, wall time, until transforms come in; false where none did.
  bool wait_for_change(std::int64_t timeout_ns) const;

  // Told after each transform that comes in.
  std::uint64_t add_listener(std::function<void()> listener);
  void remove_listener(std::uint64_t number);

  bool exists(const std::string& frame) const;
  bool parent(const std::string& frame, std::int64_t stamp_ns, std::string& out) const;
  std::vector<std::string> names() const;
  FrameId number(const std::string& frame) const;  // 0: none
  FrameId number_or_new(const std::string& frame);
  const std::string& name(FrameId number) const;
  FrameId checked_number(const char* argument, const std::string& frame) const;
  FrameFault latest_common_time(FrameId target, FrameId source, std::int64_t& stamp_ns,
                                std::string* why) const;
  // Frames from source to target by way of the fixed one.
  std::vector<std::string> chain(const std::string& target, std::int64_t target_ns,
                                 const std::string& source, std::int64_t source_ns,
                                 const std::string& fixed) const;

  std::string as_text() const;
  // `now_s` 0: without ages.
  std::string as_yaml(double now_s) const;
  std::string as_dot(double now_s) const;

 private:
  struct Frame {
    std::string name;
    std::string authority = "no recorded authority";
    std::deque<FrameSample> samples;  // in order of time; one where the frame never moves
    bool is_static = false;

    bool has_parent() const { return !samples.empty(); }
    // 0 where it never moves, as then any time is fine.
    std::int64_t newest_ns() const { return is_static ? 0 : samples.back().stamp_ns; }
    std::int64_t oldest_ns() const { return is_static ? 0 : samples.front().stamp_ns; }
  };
  struct Request {
    std::uint64_t handle;
    std::string target, source;
    std::int64_t stamp_ns;
    Waiting done;
  };

  // All of these want the lock.
  bool add(Frame& frame, const FrameSample& sample);
  FrameId find(const std::string& frame) const;
  FrameId find_or_add(const std::string& frame);
  FrameId check(const char* argument, const std::string& frame) const;
  FrameFault at(const Frame& frame, std::int64_t stamp_ns, FrameSample& out,
                std::string* why) const;
  FrameFault common_time(FrameId target, FrameId source, std::int64_t& stamp_ns,
                         std::string* why) const;
  FrameFault walk(FrameId target, FrameId source, std::int64_t stamp_ns, FoundTransform* out,
                  std::vector<FrameId>* through, std::string* why) const;
  FrameFault ancestors(FrameId frame, std::vector<FrameId>& out, std::string* why) const;
  FoundTransform look_up_locked(FrameId target, FrameId source, std::int64_t stamp_ns) const;
  bool can_locked(FrameId target, FrameId source, std::int64_t stamp_ns, std::string* why) const;
  bool known(const char* argument, const std::string& frame, std::string* why) const;
  std::string unconnected(FrameId target, FrameId source) const;
  std::string text_locked() const;
  double rate(const Frame& frame) const;

  void warn(const std::string& text);
  void answer_requests();

  const std::int64_t cache_ns_;
  const Words words_;
  mutable std::mutex lock_;
  mutable std::condition_variable changed_;
  std::uint64_t changes_ = 0;
  std::deque<Frame> frames_;  // by number; a deque, as names are handed out by reference
  std::unordered_map<std::string, FrameId> numbers_;
  std::vector<Request> requests_;
  std::uint64_t last_handle_ = 0;
  std::vector<std::pair<std::uint64_t, std::function<void()>>> listeners_;
  std::uint64_t last_listener_ = 0;
  Warning warning_;
  std::vector<std::string> warned_;
};

}  // namespace gazelle
