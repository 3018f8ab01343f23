#include "frame_texts.hpp"

#include <algorithm>
#include <cctype>
#include <cinttypes>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace gazelle::frame_texts {

const char* const loop = "The tf tree is invalid because it contains a loop.\n";

namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  std::va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string out(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  va_end(arguments);
  std::vsnprintf(out.data(), out.size() + 1, pattern, again);
  va_end(again);
  return out;
}

std::string seconds(std::int64_t ns) {
  const std::int64_t rest = ((ns % 1000000000) + 1000000000) % 1000000000;
  return format("%" PRId64 ".%09" PRId64, (ns - rest) / 1000000000, rest);
}

// Above is 0, as REP 105 stacks frames: maps, odom, bases, the robot's other frames.
int rank(const std::string& frame) {
  const std::string bare = frame.substr(frame.rfind('/') + 1);
  if (bare == "map" || bare == "earth" || bare == "world") return 0;
  if (bare == "odom") return 1;
  return bare == "base_footprint" || bare == "base_link" || bare == "base" ? 2 : 3;
}

const char* owner(const std::string& parent, const std::string& child) {
  const int above = rank(parent), below = rank(child);
  if (above == 0 && below == 1) return "localisation or SLAM (amcl, gmapping, slam_toolbox)";
  if (above == 1 && below >= 2)
    return "the drive (plug-in: <publishOdomTF>, publish_odom_tf; diff_drive_controller: "
           "enable_odom_tf) or robot_localization";
  return "robot_state_publisher, which wants every joint in /joint_states, or a "
         "static_transform_publisher";
}

std::string folded(std::string text) {
  for (char& letter : text)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

// Characters in the longest common piece, and in those left and right of it.
std::size_t alike(const std::string& a, std::size_t a0, std::size_t a1, const std::string& b,
                  std::size_t b0, std::size_t b1) {
  std::size_t best = 0, at_a = a0, at_b = b0;
  for (std::size_t i = a0; i < a1; ++i) {
    for (std::size_t j = b0; j < b1; ++j) {
      std::size_t n = 0;
      while (i + n < a1 && j + n < b1 && a[i + n] == b[j + n]) ++n;
      if (n > best) best = n, at_a = i, at_b = j;
    }
  }
  if (best == 0) return 0;
  return best + alike(a, a0, at_a, b, b0, at_b) + alike(a, at_a + best, a1, b, at_b + best, b1);
}

}  // namespace

std::string problem(const std::string& frame, const std::string& child,
                    const tf2::Vector3& translation, const tf2::Quaternion& rotation,
                    double norm_tolerance, const std::string& authority) {
  const char *by = authority.c_str(), *whose = child.c_str();
  if (frame == child)
    return format(
        "TF_SELF_TRANSFORM: Ignoring transform from authority \"%s\" with frame_id and "
        "child_frame_id  \"%s\" because they are the same",
        by, whose);
  if (child.empty())
    return format(
        "TF_NO_CHILD_FRAME_ID: Ignoring transform from authority \"%s\" because child_frame_id "
        "not set ",
        by);
  if (frame.empty())
    return format(
        "TF_NO_FRAME_ID: Ignoring transform with child_frame_id \"%s\"  from authority \"%s\" "
        "because frame_id not set",
        whose, by);
  const tf2::Vector3& t = translation;
  const tf2::Quaternion& q = rotation;
  if (std::isnan(t.x() + t.y() + t.z() + q.x() + q.y() + q.z() + q.w()))
    return format(
        "TF_NAN_INPUT: Ignoring transform for child_frame_id \"%s\" from authority \"%s\" because "
        "of a nan value in the transform (%f %f %f) (%f %f %f %f)",
        whose, by, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  if (std::fabs(q.length2() - 1.0) > norm_tolerance)
    return format(
        "TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id \"%s\" from authority "
        "\"%s\" because of an invalid quaternion in the transform (%f %f %f %f)",
        whose, by, q.x(), q.y(), q.z(), q.w());
  return "";
}

std::string illegal(const char* argument, const std::string& frame) {
  if (frame.empty())
    return format("Invalid argument passed to %s in tf2 frame_ids cannot be empty", argument);
  if (frame[0] == '/')
    return format(
        "Invalid argument \"%s\" passed to %s in tf2 frame_ids cannot start with a '/' like: ",
        frame.c_str(), argument);
  return "";
}

std::string unknown(const char* argument, const std::string& frame,
                    const std::vector<std::string>& known) {
  std::string text = format("\"%s\" passed to %s does not exist. ", frame.c_str(), argument);
  std::vector<std::pair<double, std::string>> near;
  const std::string asked = folded(frame);
  for (const std::string& one : known) {
    const std::string other = folded(one);
    if (asked.size() > 200 || other.size() > 200) continue;
    const double likeness =
        2.0 * static_cast<double>(alike(asked, 0, asked.size(), other, 0, other.size())) /
        static_cast<double>(asked.size() + other.size());
    if (likeness >= 0.6) near.emplace_back(likeness, one);
  }
  std::sort(near.rbegin(), near.rend());
  if (near.size() > 3) near.resize(3);
  for (std::size_t i = 0; i < near.size(); ++i)
    text += (i == 0 ? "Did you mean " : " or ") + near[i].second;
  return near.empty() ? text : text + "?";
}

std::string cannot_ros1(const char* argument, const std::string& frame) {
  return format("canTransform: %s %s does not exist.", argument, frame.c_str());
}

std::string cannot_ros2(const char* argument, const std::string& frame) {
  const std::string where = std::string("canTransform argument ") + argument;
  const std::string wrong = illegal(where.c_str(), frame);
  if (!wrong.empty()) return wrong;
  return format("Invalid frame ID \"%s\" passed to %s - frame does not exist", frame.c_str(),
                where.c_str());
}

std::string outside(std::int64_t asked_ns, std::int64_t oldest_ns, std::int64_t newest_ns,
                    std::size_t count) {
  const std::string asked = seconds(asked_ns), oldest = seconds(oldest_ns),
                    newest = seconds(newest_ns);
  if (count == 1)
    return "Lookup would require extrapolation at time " + asked + ", but only time " + oldest +
           " is in the buffer";
  if (asked_ns > newest_ns)
    return "Lookup would require extrapolation " + seconds(asked_ns - newest_ns) +
           "s into the future.  Requested time " + asked + " but the latest data is at time " +
           newest;
  return "Lookup would require extrapolation " + seconds(oldest_ns - asked_ns) +
         "s into the past.  Requested time " + asked + " but the earliest data is at time " +
         oldest;
}

std::string unconnected(const std::string& target, const std::string& source,
                        const std::string& target_root, const std::string& source_root) {
  const bool in_order = rank(target_root) <= rank(source_root);
  const std::string &parent = in_order ? target_root : source_root,
                    &child = in_order ? source_root : target_root;
  return "Could not find a connection between '" + target + "' and '" + source +
         "' because they are not part of the same tree.Tf has two or more unconnected trees.\n"
         "  nobody publishes a transform from the tree of '" +
         parent + "' to '" + child + "'; that is the job of " + owner(parent, child);
}

std::string yaml(const std::string& name, const std::string& parent, const std::string& authority,
                 double rate, double newest_s, double oldest_s, double now_s) {
  std::string out = format(
      "%s: \n  parent: '%s'\n  broadcaster: '%s'\n  rate: %.3f\n  most_recent_transform: %.3f\n"
      "  oldest_transform: %.3f\n",
      name.c_str(), parent.c_str(), authority.c_str(), rate, newest_s, oldest_s);
  if (now_s > 0) out += format("  transform_delay: %.3f\n", now_s - newest_s);
  return out + format("  buffer_length: %.3f\n", newest_s - oldest_s);
}

std::string dot_edge(const std::string& name, const std::string& parent,
                     const std::string& authority, double rate, double newest_s, double oldest_s,
                     double now_s) {
  std::string age;
  if (now_s > 0) age = format("( %.3f sec old)", now_s - newest_s);
  return format(
      "\"%s\" -> \"%s\"[label=\"Broadcaster: %s\\nAverage rate: %.3f Hz\\nMost recent transform: "
      "%.3f %s\\nBuffer length: %.3f sec\\n\"];\n",
      parent.c_str(), name.c_str(), authority.c_str(), rate, newest_s, age.c_str(),
      newest_s - oldest_s);
}

std::string dot_graph(const std::string& edges, const std::vector<std::string>& roots,
                      double now_s) {
  if (edges.empty()) return "digraph G {\n\"no tf data recieved\"\n}";
  std::string out = "digraph G {\n" + edges;
  for (const std::string& root : roots) {
    out +=
        "edge [style=invis];\n"
        " subgraph cluster_legend { style=bold; color=black; label =\"view_frames Result\";\n";
    if (now_s > 0) out += format("\"Recorded at time: %.3f\"[ shape=plaintext ] ;\n ", now_s);
    out += "}->\"" + root + "\";\n";
  }
  return out + "}";
}

}  // namespace gazelle::frame_texts
