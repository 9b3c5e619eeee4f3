#include "engine/base/json_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "engine/base/input_error.hpp"

namespace repose {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDeepest = 64;

/// Goes through a text once and notes what the DOM parser would accept or lose: the place of an error, keys
/// given twice, nesting that recursive code could not follow.
class StrictChecker : public nlohmann::json_sax<Json> {
 public:
  StrictChecker(std::string file, const std::string& text) : file_(std::move(file)), text_(text) {}

  bool null() override { return next(); }
  bool boolean(bool) override { return next(); }
  bool number_integer(number_integer_t) override { return next(); }
  bool number_unsigned(number_unsigned_t) override { return next(); }
  bool number_float(number_float_t, const string_t&) override { return next(); }
  bool string(string_t&) override { return next(); }
  bool binary(binary_t&) override { return next(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second) faults.add(file_, pointer(), "", "is given twice");
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) override {
    // byte counts from 1 and points at the last character read
    const std::size_t end = std::min(byte == 0 ? 0 : byte - 1, text_.size());
    const auto begin = text_.begin();
    const auto lines = std::count(begin, begin + static_cast<std::ptrdiff_t>(end), '\n');
    const std::size_t newline = end == 0 ? std::string::npos : text_.rfind('\n', end - 1);
    const std::size_t column = newline == std::string::npos ? end + 1 : end - newline;
    faults.add(file_, fmt::format("line {}, column {}", lines + 1, column), "",
               "is not JSON: " + reason(error.what()));
    return false;
  }

  Faults faults;

 private:
  struct Level {
    bool list = false;
    std::size_t index = 0;
    std::string key;
    std::set<std::string> keys;
  };

  /// The parser's words without its own numbering: "[json.exception.parse_error.101] parse error at line 1,
  /// column 2: syntax error …".
  static std::string reason(std::string words) {
    if (const auto end = words.find("] "); end != std::string::npos) words.erase(0, end + 2);
    if (const auto end = words.find(": "); words.starts_with("parse error at") && end != std::string::npos)
      words.erase(0, end + 2);
    return words;
  }

  bool next() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }

  bool open(bool list) {
    if (levels_.size() == kDeepest) {
      faults.add(file_, pointer(), "", fmt::format("is nested deeper than {}", kDeepest));
      return false;
    }
    levels_.push_back({.list = list, .index = 0, .key = {}, .keys = {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return next();
  }

  [[nodiscard]] std::string pointer() const {
    std::string pointer;
    for (const Level& level : levels_)
      pointer = pointer_to(pointer, level.list ? std::to_string(level.index) : level.key);
    return pointer;
  }

  std::string file_;
  const std::string& text_;
  std::vector<Level> levels_;
};

}  // namespace

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError({file.string(), "", "", "cannot be opened"});
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_json(text, file.string());
}

Json parse_json(const std::string& text, const std::string& name) {
  StrictChecker checker(name, text);
  Json::sax_parse(text, &checker);
  checker.faults.throw_if_any();
  return Json::parse(text);
}

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    return fmt::format("{}", value.get<double>());
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kLongest) {
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
      --end;  // not inside a character
    text = text.substr(0, end) + "…";
  }
  return text;
}

std::optional<std::vector<std::string>> pointer_parts(std::string_view pointer) {
  std::vector<std::string> parts;
  if (pointer.empty()) return parts;
  if (pointer.front() != '/') return std::nullopt;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      parts.emplace_back();
    } else if (pointer[i] == '~') {
      const char code = ++i < pointer.size() ? pointer[i] : '\0';
      if (code != '0' && code != '1') return std::nullopt;
      parts.back() += code == '0' ? '~' : '/';
    } else {
      parts.back() += pointer[i];
    }
  }
  return parts;
}

bool is_or_is_below(std::string_view pointer, std::string_view other) {
  return pointer.starts_with(other) && (pointer.size() == other.size() || pointer[other.size()] == '/');
}

std::string pointer_to(std::string_view parent, std::string_view key) {
  std::string pointer = std::string(parent) + "/";
  for (const char c : key) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
  return pointer;
}

std::optional<std::size_t> list_index(std::string_view part) {
  if (part.empty() || (part.size() > 1 && part.front() == '0')) return std::nullopt;
  std::size_t index = 0;
  const char* last = part.data() + part.size();
  const auto [end, error] = std::from_chars(part.data(), last, index);
  if (error != std::errc{} || end != last) return std::nullopt;
  return index;
}

const Json* value_at(const Json& root, std::string_view pointer) {
  const auto parts = pointer_parts(pointer);
  if (!parts) return nullptr;
  const Json* value = &root;
  for (const std::string& part : *parts) {
    if (value->is_object()) {
      const auto found = value->find(part);
      if (found == value->end()) return nullptr;
      value = &*found;
    } else if (const auto index = list_index(part); value->is_array() && index && *index < value->size()) {
      value = &(*value)[*index];
    } else {
      return nullptr;
    }
  }
  return value;
}

Json* value_at(Json& root, std::string_view pointer) {
  return const_cast<Json*>(value_at(std::as_const(root), pointer));  // root itself may be changed
}

}  // namespace repose
