#include "engine/shape/length_unit.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <map>
#include <string_view>

#include "engine/shape/mesh_formats.hpp"

namespace repose {

namespace {

const std::array<LengthUnit, 5>& units_of_length() {
  static const std::array<LengthUnit, 5> units = {
      {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}}};
  return units;
}

std::map<std::string, LengthUnit> known_units() {
  const std::array<LengthUnit, 5>& units = units_of_length();
  const std::array<std::string, 5> prefixes = {"", "centi", "milli", "micro", ""};
  std::map<std::string, LengthUnit> words;
  for (std::size_t i = 0; i < units.size(); ++i) {
    words[units[i].name] = units[i];
    if (units[i].name == "in") continue;
    for (const char* ending : {"meter", "meters", "metre", "metres"}) words[prefixes[i] + ending] = units[i];
  }
  for (const char* word : {"inch", "inches"}) words[word] = units[4];
  for (const char* word : {"micron", "microns"}) words[word] = units[3];
  // The micro sign and the Greek letter in UTF-8, the micro sign in Latin-1.
  for (const std::string mu : {"\xC2\xB5", "\xCE\xBC", "\xB5"})
    for (const char* ending : {"m", "meter", "meters", "metre", "metres"}) words[mu + ending] = units[3];
  return words;
}

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Where the word after "unit" or "units" and its sign begins, for an occurrence of "unit" at `at`.
std::optional<std::size_t> value_after(const std::string& text, std::size_t at) {
  const auto past_blanks = [&](std::size_t from) {
    return std::min(text.find_first_not_of(" \t", from), text.size());
  };
  if (at > 0 && is_letter_or_digit(text[at - 1])) return std::nullopt;
  std::size_t end = at + std::string_view("unit").size();
  if (end < text.size() && text[end] == 's') ++end;
  end = past_blanks(end);
  if (end == text.size() || (text[end] != '=' && text[end] != ':')) return std::nullopt;
  return past_blanks(end + 1);
}

}  // namespace

std::optional<LengthUnit> length_unit(const std::string& word) {
  static const std::map<std::string, LengthUnit> units = known_units();
  const auto found = units.find(word);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

std::string unit_name(double metres) {
  for (const LengthUnit& unit : units_of_length())
    if (unit.metres == metres) return unit.name;
  return "unit";
}

std::optional<LengthUnit> named_unit(const std::string& header, const std::string& file, Faults& faults) {
  const std::string text = lower(header);
  std::optional<LengthUnit> unit;
  for (std::size_t at = text.find("unit"); at != std::string::npos; at = text.find("unit", at + 1)) {
    auto start = value_after(text, at);
    if (!start) continue;
    if (*start < text.size() && (text[*start] == '"' || text[*start] == '\'')) ++*start;
    const auto end = text.find_first_of(std::string_view(" \t\r\n\0\"',;()[]", 14), *start);
    std::string word = text.substr(*start, end == std::string::npos ? end : end - *start);
    if (word.ends_with('.')) word.pop_back();
    const std::optional<LengthUnit> found = length_unit(word);
    if (!found)
      faults.add(
          file, "header", fmt::format("unit '{}'", word),
          "is no unit that is known: m, cm, mm, um, in, or written out, such as millimetres or inches");
    else if (unit && unit->metres != found->metres)
      faults.add(file, "header", fmt::format("units {} and {}", unit->name, found->name),
                 "must name one unit");
    else
      unit = found;
  }
  return unit;
}

}  // namespace repose
