// Angles: degrees and radians, normalising, the way from one to another within limits.
#pragma once

#include <algorithm>
#include <cmath>

namespace angles {

inline double from_degrees(double degrees) { return degrees * M_PI / 180.0; }
inline double to_degrees(double radians) { return radians * 180.0 / M_PI; }

// To [0, 2π).
inline double normalize_angle_positive(double angle) {
  const double rest = std::fmod(angle, 2.0 * M_PI);
  return rest < 0.0 ? std::fmod(rest + 2.0 * M_PI, 2.0 * M_PI) : rest;
}
// To (-π, π].
inline double normalize_angle(double angle) {
  const double rest = std::fmod(angle + M_PI, 2.0 * M_PI);
  return rest <= 0.0 ? rest + M_PI : rest - M_PI;
}
inline double shortest_angular_distance(double from, double to) {
  return normalize_angle(to - from);
}
// The same angle, the other way round.
inline double two_pi_complement(double angle) {
  const double rest = std::fmod(angle, 2.0 * M_PI);
  if (rest < 0.0) return 2.0 * M_PI + rest;
  if (rest > 0.0) return rest - 2.0 * M_PI;
  return 2.0 * M_PI;
}

// How far it is down and up from an angle to the limits; false where it lies outside.
inline bool find_min_max_delta(double from, double left_limit, double right_limit,
                               double& result_min_delta, double& result_max_delta) {
  const double down = shortest_angular_distance(from, left_limit);
  const double up = shortest_angular_distance(from, right_limit);
  const double down_other = two_pi_complement(down), up_other = two_pi_complement(up);
  if (down == 0.0) {
    result_min_delta = down;
    result_max_delta = std::max(up, up_other);
    return true;
  }
  if (up == 0.0) {
    result_max_delta = up;
    result_min_delta = std::min(down, down_other);
    return true;
  }
  // Each limit lies down and up the circle; inside, the left one is met first on the way down.
  const double left_down = std::min(down, down_other), left_up = std::max(down, down_other);
  const double right_down = std::min(up, up_other), right_up = std::max(up, up_other);
  if (left_down <= right_down || right_up >= left_up) {
    result_min_delta = right_down;
    result_max_delta = left_up;
    return left_limit == -M_PI && right_limit == M_PI;
  }
  result_min_delta = left_down;
  result_max_delta = right_up;
  return true;
}

// The way within limits that may be more than a turn apart. Where there is none, false, and the way
// to a limit that is nearest.
inline bool shortest_angular_distance_with_large_limits(double from, double to, double left_limit,
                                                        double right_limit,
                                                        double& shortest_angle) {
  const double way = shortest_angular_distance(from, to);
  shortest_angle = way;
  if (left_limit > right_limit) return false;
  const auto is_inside = [&](double angle) { return left_limit <= angle && angle <= right_limit; };
  if (!is_inside(from)) return false;
  if (is_inside(from + way)) return true;
  const double other = two_pi_complement(way);
  if (is_inside(from + other)) {
    shortest_angle = other;
    return true;
  }
  const double down = left_limit - from, up = right_limit - from;
  const double beyond_left = std::fabs(shortest_angular_distance(left_limit, to));
  const double beyond_right = std::fabs(shortest_angular_distance(right_limit, to));
  shortest_angle = beyond_left < beyond_right ? down : up;
  return false;
}

// The way from one angle to another that stays within limits; false where an end lies outside.
inline bool shortest_angular_distance_with_limits(double from, double to, double left_limit,
                                                  double right_limit, double& shortest_angle) {
  double min_delta = -2.0 * M_PI, max_delta = 2.0 * M_PI;
  double min_delta_to = -2.0 * M_PI, max_delta_to = 2.0 * M_PI;
  const bool is_from_inside =
      find_min_max_delta(from, left_limit, right_limit, min_delta, max_delta);
  const double way = shortest_angular_distance(from, to);
  const double other = two_pi_complement(way);
  if (is_from_inside) {
    if (way >= min_delta && way <= max_delta) {
      shortest_angle = way;
      return true;
    }
    if (other >= min_delta && other <= max_delta) {
      shortest_angle = other;
      return true;
    }
    find_min_max_delta(to, left_limit, right_limit, min_delta_to, max_delta_to);
    if (std::fabs(min_delta_to) < std::fabs(max_delta_to)) {
      shortest_angle = std::max(way, other);
    } else if (std::fabs(min_delta_to) > std::fabs(max_delta_to)) {
      shortest_angle = std::min(way, other);
    } else {
      shortest_angle = std::fabs(way) < std::fabs(other) ? way : other;
    }
    return false;
  }
  find_min_max_delta(to, left_limit, right_limit, min_delta_to, max_delta_to);
  if (std::fabs(min_delta) < std::fabs(max_delta)) {
    shortest_angle = std::min(way, other);
  } else if (std::fabs(min_delta) > std::fabs(max_delta)) {
    shortest_angle = std::max(way, other);
  } else {
    shortest_angle = std::fabs(way) < std::fabs(other) ? way : other;
  }
  return false;
}

}  // namespace angles
