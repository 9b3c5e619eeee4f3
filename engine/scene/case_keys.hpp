#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace repose {

/// What a key of a case holds.
enum class KeyKind {
  object,
  list,
  number,
  integer,
  text,
  marker,   ///< true; a key that is there or not
  anything  ///< read elsewhere, not looked into here
};

/// Values that a number may take, or lengths that a list may have.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is not allowed
  bool high_open = false;  ///< high itself is not allowed

  [[nodiscard]] constexpr bool holds(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
  /// "> 0", ">= 0 and < 0.5", "between 0 and 1", "1" where only one value is allowed.
  [[nodiscard]] std::string text() const;
};

/// One key of a case: where it may stand and which values it may have, each on its own. Rules between values
/// are in the readers.
struct CaseKey {
  std::string_view pattern;  ///< JSON pointer; "*" stands for any entry of a list
  KeyKind kind = KeyKind::anything;
  Range range = {};                            ///< of a number; of a list's length
  std::vector<std::string_view> choices = {};  ///< of a text; of a number: words that may stand in its place
  bool required = false;                       ///< wherever the object that it belongs to stands

  /// "must be a number", "must be one of "force", "displacement"", …
  [[nodiscard]] std::string type_rule() const;
};

/// Every key of a case, each after the object or list that holds it.
std::span<const CaseKey> case_keys();

/// The key that a pointer leads to ("/particles/shapes/0/mesh"), or nullptr where a case knows none. Below a
/// key that is read elsewhere every pointer leads to that key.
const CaseKey* find_case_key(std::string_view pointer);

/// What is wrong with a pointer that find_case_key() does not know: `is not known; did you mean
/// "restitution"?` or `is not known; /walls takes density_kg_m3, …`.
std::string unknown_key_rule(std::string_view pointer);

/// Keys that the object of this pattern takes ("" is the case itself), without their path.
std::vector<std::string_view> keys_below(std::string_view pattern);

/// Two keys of which a case gives at most one.
struct RivalKeys {
  std::string_view first;
  std::string_view second;
};
/// A file that gives one of the two replaces the other that it inherits.
std::span<const RivalKeys> rival_keys();
/// Whether two pointers are such a pair.
bool are_rivals(std::string_view pointer, std::string_view other);

/// A factor's name and the key that it stands for.
struct FactorName {
  std::string_view name;
  std::string_view pointer;
};
/// e_pp, mu_s, mu_r (particle–particle) and e_pw, mu_s_pw, mu_r_pw (particle–wall).
std::span<const FactorName> factor_names();

/// The pointer that a factor moves: of its name, or the name itself where it is a pointer to a number of a
/// case. Nothing where it is neither.
std::optional<std::string> factor_pointer(std::string_view name);

/// What is wrong with a name that factor_pointer() does not know: the names there are, or the one that is
/// close.
std::string factor_rule(std::string_view name);

}  // namespace repose
