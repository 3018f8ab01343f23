// fmt::format and fmt::print for machines without fmt: braces, positions, widths, numbers.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace fmt {

struct format_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

template <class T, class = void>
struct IsRange : std::false_type {};
template <class T>
struct IsRange<T, std::void_t<decltype(std::declval<const T&>().begin()),
                              decltype(std::declval<const T&>().end())>> : std::true_type {};

// "[fill][<>^][+][0][width][.precision][type]"
struct Spec {
  char fill = ' ';
  char side = 0;
  bool plus = false;
  std::size_t width = 0;
  int precision = -1;
  char type = 0;

  explicit Spec(std::string_view text) {
    std::size_t at = 0;
    const auto is_side = [](char letter) {
      return letter == '<' || letter == '>' || letter == '^';
    };
    if (text.size() > 1 && is_side(text[1])) {
      fill = text[0];
      side = text[1];
      at = 2;
    } else if (!text.empty() && is_side(text[0])) {
      side = text[0];
      at = 1;
    }
    if (at < text.size() && text[at] == '+') {
      plus = true;
      ++at;
    }
    if (at < text.size() && text[at] == '#') ++at;
    if (at < text.size() && text[at] == '0') {
      fill = '0';
      ++at;
    }
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') {
      width = width * 10 + static_cast<std::size_t>(text[at++] - '0');
    }
    if (at < text.size() && text[at] == '.') {
      precision = 0;
      for (++at; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
        precision = precision * 10 + (text[at] - '0');
      }
    }
    if (at < text.size()) type = text[at];
  }
};

template <class T>
void write(std::ostream& out, const T& value, const Spec& spec) {
  if constexpr (std::is_same<T, bool>::value) {
    out << (value ? "true" : "false");
  } else if constexpr (std::is_same<T, char>::value) {
    out << value;
  } else if constexpr (std::is_enum<T>::value) {
    write(out, static_cast<std::underlying_type_t<T>>(value), spec);
  } else if constexpr (std::is_integral<T>::value) {
    if (spec.plus && value >= 0) out << '+';
    if (spec.type == 'x') out << std::hex;
    if (spec.type == 'X') out << std::hex << std::uppercase;
    if (spec.type == 'o') out << std::oct;
    out << +value;
  } else if constexpr (std::is_floating_point<T>::value) {
    if (spec.plus && value >= 0) out << '+';
    if (spec.type == 'f' || spec.type == 'F') {
      out << std::fixed << std::setprecision(spec.precision < 0 ? 6 : spec.precision);
    } else if (spec.type == 'e' || spec.type == 'E') {
      out << std::scientific << std::setprecision(spec.precision < 0 ? 6 : spec.precision);
    } else if (spec.precision >= 0) {
      out << std::setprecision(spec.precision);
    } else {
      // The shortest text that reads back as the same number.
      for (int digits = 1; digits <= 17; ++digits) {
        std::ostringstream shown;
        shown << std::setprecision(digits) << value;
        if (digits == 17 || static_cast<T>(std::strtod(shown.str().c_str(), nullptr)) == value) {
          out << shown.str();
          return;
        }
      }
    }
    out << value;
  } else if constexpr (std::is_convertible<const T&, std::string_view>::value) {
    const std::string_view text = value;
    out << (spec.precision < 0 ? text : text.substr(0, static_cast<std::size_t>(spec.precision)));
  } else if constexpr (IsRange<T>::value) {
    out << '[';
    bool is_first = true;
    for (const auto& item : value) {
      if (!std::exchange(is_first, false)) out << ", ";
      if constexpr (std::is_convertible<decltype(item), std::string_view>::value) {
        out << '"' << std::string_view(item) << '"';
      } else {
        write(out, item, spec);
      }
    }
    out << ']';
  } else {
    out << value;
  }
}

template <class T>
std::string padded(const T& value, std::string_view words) {
  const Spec spec(words);
  std::ostringstream out;
  write(out, value, spec);
  std::string text = out.str();
  if (text.size() >= spec.width) return text;
  const std::size_t room = spec.width - text.size();
  const char side = spec.side != 0 ? spec.side : std::is_arithmetic<T>::value ? '>' : '<';
  if (side == '<') return text + std::string(room, spec.fill);
  const std::size_t before = side == '^' ? room / 2 : room;
  return std::string(before, spec.fill) + text + std::string(room - before, spec.fill);
}

}  // namespace detail

template <class... Arguments>
std::string format(std::string_view pattern, const Arguments&... arguments) {
  std::string made;
  std::size_t next = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char letter = pattern[i];
    if ((letter == '{' || letter == '}') && i + 1 < pattern.size() && pattern[i + 1] == letter) {
      made += letter;
      ++i;
      continue;
    }
    if (letter != '{') {
      made += letter;
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    if (end == std::string_view::npos) throw format_error("unmatched '{' in format string");
    std::string_view inside = pattern.substr(i + 1, end - i - 1);
    const std::size_t colon = inside.find(':');
    const std::string_view place = inside.substr(0, colon);
    const std::string_view words =
        colon == std::string_view::npos ? std::string_view() : inside.substr(colon + 1);
    const std::size_t number = place.empty() ? next++ : std::stoul(std::string(place));
    if (number >= sizeof...(arguments)) throw format_error("argument not found");
    std::size_t at = 0;
    ((at++ == number ? void(made += detail::padded(arguments, words)) : void()), ...);
    i = end;
  }
  return made;
}

template <class... Arguments>
void print(std::string_view pattern, const Arguments&... arguments) {
  std::fputs(format(pattern, arguments...).c_str(), stdout);
}
template <class... Arguments>
void print(std::FILE* file, std::string_view pattern, const Arguments&... arguments) {
  std::fputs(format(pattern, arguments...).c_str(), file);
}

template <class T>
std::string to_string(const T& value) {
  return format("{}", value);
}

template <class Range>
struct Joined {
  const Range& range;
  std::string_view between;
  friend std::ostream& operator<<(std::ostream& out, const Joined& joined) {
    bool is_first = true;
    for (const auto& item : joined.range) {
      if (!std::exchange(is_first, false)) out << joined.between;
      detail::write(out, item, detail::Spec(""));
    }
    return out;
  }
};
template <class Range>
Joined<Range> join(const Range& range, std::string_view between) {
  return {range, between};
}

}  // namespace fmt
