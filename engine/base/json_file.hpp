#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace repose {

/// Reads a JSON file; keys keep their order. Stricter than the JSON grammar: a key given twice in one object
/// is a fault (silently keeping one of the two would hide a mistake), and so is nesting deeper than 64.
/// Throws InputError: file missing, not JSON (with line, column and what was expected), a number too large
/// for a double, keys given twice (all of them).
nlohmann::ordered_json read_json(const std::filesystem::path& file);

/// The same for a text; `name` is what messages call it.
nlohmann::ordered_json parse_json(const std::string& text, const std::string& name);

/// A value as a message shows it: JSON on one line, cut after 60 characters; a number that JSON cannot hold
/// by its name (nan, inf).
std::string shown(const nlohmann::ordered_json& value);

/// The parts of a JSON pointer, unescaped (RFC 6901): "/a/0/b~1c" is {"a", "0", "b/c"}; "" has none.
/// Nothing where the text is not a pointer (it must be empty or begin with '/').
std::optional<std::vector<std::string>> pointer_parts(std::string_view pointer);

/// pointer + "/" + the key, escaped.
std::string pointer_to(std::string_view parent, std::string_view key);

/// Whether a pointer is another or leads to something below it: "/a/b" and "/a", not "/ab" and "/a".
bool is_or_is_below(std::string_view pointer, std::string_view other);

/// The entry of a list that a part of a pointer names ("0", "12", not "01"), or nothing.
std::optional<std::size_t> list_index(std::string_view part);

/// The value at a pointer, or nullptr where there is none.
const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& root, std::string_view pointer);
nlohmann::ordered_json* value_at(nlohmann::ordered_json& root, std::string_view pointer);

}  // namespace repose
