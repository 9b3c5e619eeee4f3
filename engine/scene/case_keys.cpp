#include "engine/scene/case_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "engine/base/json_file.hpp"
#include "engine/scene/did_you_mean.hpp"
#include "engine/scene/names.hpp"
#include "engine/shape/clump_generator.hpp"

namespace repose {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0.0, .high = kNone, .low_open = true};
constexpr Range kNotNegative{.low = 0.0};
constexpr Range kFraction{.low = 0.0, .high = 1.0};
constexpr Range kPercent{.low = 0.0, .high = 100.0};
constexpr Range kPoisson{.low = 0.0, .high = 0.5, .low_open = false, .high_open = true};
constexpr Range kAtLeastOne{.low = 1.0};
constexpr Range kSpheres{.low = 1.0, .high = kMostSpheres};
constexpr Range kColumns{.low = 1.0, .high = 100.0};
constexpr Range kTwo{.low = 2.0, .high = 2.0};
constexpr Range kSchema{.low = 1.0, .high = 1.0};

CaseKey object(std::string_view pattern) { return {.pattern = pattern, .kind = KeyKind::object}; }
CaseKey list(std::string_view pattern, Range length) {
  return {.pattern = pattern, .kind = KeyKind::list, .range = length};
}
CaseKey number(std::string_view pattern, Range range) {
  return {.pattern = pattern, .kind = KeyKind::number, .range = range};
}
CaseKey integer(std::string_view pattern, Range range) {
  return {.pattern = pattern, .kind = KeyKind::integer, .range = range};
}
CaseKey text(std::string_view pattern) { return {.pattern = pattern, .kind = KeyKind::text}; }
CaseKey choice(std::string_view pattern, std::vector<std::string_view> names) {
  return {.pattern = pattern, .kind = KeyKind::text, .choices = std::move(names)};
}
CaseKey required(CaseKey key) {
  key.required = true;
  return key;
}

std::vector<CaseKey> make_keys() {
  CaseKey step = number("/numerics/time_step_fraction", kPositive);
  step.choices = {"auto"};
  return {
      {.pattern = "", .kind = KeyKind::object},
      text("/$schema"),
      required(integer("/schema", kSchema)),
      text("/title"),
      text("/base"),

      required(object("/particles")),
      required(number("/particles/density_kg_m3", kPositive)),
      required(number("/particles/shear_modulus_Pa", kPositive)),
      required(number("/particles/poisson_ratio", kPoisson)),
      required(list("/particles/shapes", kAtLeastOne)),
      object("/particles/shapes/*"),
      {.pattern = "/particles/shapes/*/sphere", .kind = KeyKind::marker},
      number("/particles/shapes/*/diameter_mm", kPositive),
      text("/particles/shapes/*/clump"),
      text("/particles/shapes/*/mesh"),
      integer("/particles/shapes/*/spheres", kSpheres),
      text("/particles/shapes/*/unit"),
      list("/particles/size_classes", kAtLeastOne),
      object("/particles/size_classes/*"),
      list("/particles/size_classes/*/volume_mm3", kTwo),
      number("/particles/size_classes/*/volume_mm3/*", kPositive),
      number("/particles/size_classes/*/diameter_mm", kPositive),
      number("/particles/size_classes/*/percent", kPercent),
      number("/particles/size_classes/*/mass_percent", kPercent),
      required(number("/particles/total_mass_kg", kPositive)),
      number("/particles/coarse_graining", kAtLeastOne),

      required(object("/walls")),
      required(number("/walls/density_kg_m3", kPositive)),
      required(number("/walls/shear_modulus_Pa", kPositive)),
      required(number("/walls/poisson_ratio", kPoisson)),

      required(object("/contact")),
      required(object("/contact/particle_particle")),
      required(number("/contact/particle_particle/restitution", kFraction)),
      required(number("/contact/particle_particle/static_friction", kNotNegative)),
      required(number("/contact/particle_particle/rolling_friction", kNotNegative)),
      required(object("/contact/particle_wall")),
      required(number("/contact/particle_wall/restitution", kFraction)),
      required(number("/contact/particle_wall/static_friction", kNotNegative)),
      required(number("/contact/particle_wall/rolling_friction", kNotNegative)),
      choice("/contact/rolling_model", choice_names<RollingModel>()),
      choice("/contact/tangential_history", choice_names<TangentialHistory>()),
      choice("/contact/normal_damping", choice_names<NormalDamping>()),
      number("/contact/rolling_damping_ratio", kNotNegative),
      choice("/contact/rolling_torque", choice_names<RollingTorque>()),

      required(object("/test")),
      required(choice("/test/kind", choice_names<TestKind>())),
      object("/test/base"),
      number("/test/base/diameter_mm", kPositive),
      number("/test/base/height_mm", kPositive),
      required(object("/test/cylinder")),
      required(number("/test/cylinder/diameter_mm", kPositive)),
      required(number("/test/cylinder/height_mm", kPositive)),
      choice("/test/filling", choice_names<Filling>()),
      number("/test/pour_rate_kg_s", kPositive),
      number("/test/pour_speed_m_s", kNotNegative),
      choice("/test/opening", choice_names<Opening>()),
      number("/test/opening_speed_m_s", kPositive),
      object("/test/shared_columns"),
      required(integer("/test/shared_columns/count", kColumns)),
      number("/test/shared_columns/restitution", kFraction),
      number("/test/shared_columns/static_friction", kNotNegative),
      number("/test/shared_columns/rolling_friction", kNotNegative),

      object("/numerics"),
      step,
      number("/numerics/time_step_s", kPositive),
      number("/numerics/stiffness_scale", kPositive),
      choice("/numerics/integrator", choice_names<Integrator>()),
      choice("/numerics/arithmetic", choice_names<Arithmetic>()),
      number("/numerics/settle_energy_ratio", kPositive),
      number("/numerics/rest_energy_ratio", kPositive),
      number("/numerics/rest_angle_change_deg", kPositive),
      number("/numerics/stage_time_limit_s", kPositive),

      object("/measure"),
      list("/measure/window", kTwo),
      number("/measure/window/*", kFraction),

      {.pattern = "/sweep", .kind = KeyKind::anything},
      {.pattern = "/chart", .kind = KeyKind::anything},
  };
}

const CaseKey* key_of_pattern(std::string_view pattern) {
  static const std::map<std::string_view, const CaseKey*> index = [] {
    std::map<std::string_view, const CaseKey*> by_pattern;
    for (const CaseKey& key : case_keys()) by_pattern.emplace(key.pattern, &key);
    return by_pattern;
  }();
  const auto found = index.find(pattern);
  return found == index.end() ? nullptr : found->second;
}

/// How far a pointer leads among the keys.
struct Followed {
  const CaseKey* key = nullptr;  ///< of the whole pointer, where a case knows it
  std::string parent;            ///< pattern of the last key known before the first part that is not
  std::string unknown;           ///< that part
};

Followed follow(std::string_view pointer) {
  const auto parts = pointer_parts(pointer);
  if (!parts) return {.key = nullptr, .parent = "", .unknown = std::string(pointer)};
  std::string pattern;
  const CaseKey* key = key_of_pattern(pattern);
  for (const std::string& part : *parts) {
    if (key->kind == KeyKind::anything) break;
    const bool list = key->kind == KeyKind::list;
    const std::string next = list ? pattern + "/*" : pointer_to(pattern, part);
    const CaseKey* below = list && !list_index(part) ? nullptr : key_of_pattern(next);
    if (below == nullptr) return {.key = nullptr, .parent = pattern, .unknown = part};
    pattern = next;
    key = below;
  }
  return {.key = key, .parent = {}, .unknown = {}};
}

constexpr std::array<RivalKeys, 1> kRivals{{{"/numerics/time_step_fraction", "/numerics/time_step_s"}}};

constexpr std::array<FactorName, 6> kFactors{{
    {"e_pp", "/contact/particle_particle/restitution"},
    {"mu_s", "/contact/particle_particle/static_friction"},
    {"mu_r", "/contact/particle_particle/rolling_friction"},
    {"e_pw", "/contact/particle_wall/restitution"},
    {"mu_s_pw", "/contact/particle_wall/static_friction"},
    {"mu_r_pw", "/contact/particle_wall/rolling_friction"},
}};

}  // namespace

std::string Range::text() const {
  if (low == high) return fmt::format("{}", low);
  const bool has_low = low > -kNone;
  const bool has_high = high < kNone;
  if (has_low && has_high && !low_open && !high_open) return fmt::format("between {} and {}", low, high);
  std::string words;
  if (has_low) words = fmt::format("{} {}", low_open ? ">" : ">=", low);
  if (has_low && has_high) words += " and ";
  if (has_high) words += fmt::format("{} {}", high_open ? "<" : "<=", high);
  return words;
}

std::string CaseKey::type_rule() const {
  switch (kind) {
    case KeyKind::object:
      return "must be an object";
    case KeyKind::list: {
      const bool exact = range.low == range.high;
      return fmt::format("must be a list of {}{} {}", exact ? "" : "at least ", range.low,
                         range.low == 1.0 ? "entry" : "entries");
    }
    case KeyKind::number:
      return choices.empty() ? "must be a number"
                             : fmt::format("must be a number or \"{}\"", fmt::join(choices, "\", \""));
    case KeyKind::integer:
      return "must be a whole number";
    case KeyKind::text:
      return choices.empty() ? "must be a text"
                             : fmt::format("must be one of \"{}\"", fmt::join(choices, "\", \""));
    case KeyKind::marker:
      return "must be true";
    case KeyKind::anything:
      return "";
  }
  return "";
}

std::span<const CaseKey> case_keys() {
  static const std::vector<CaseKey> keys = make_keys();
  return keys;
}

const CaseKey* find_case_key(std::string_view pointer) { return follow(pointer).key; }

std::string unknown_key_rule(std::string_view pointer) {
  const Followed last = follow(pointer);
  const std::vector<std::string_view> known = keys_below(last.parent);
  if (last.unknown.empty() || known.empty()) return "is not known";
  if (known.front() == "*") return "is not known; the entries of a list are counted from 0";
  const std::string suggestion = did_you_mean(last.unknown, known);
  if (!suggestion.empty()) return "is not known" + suggestion;
  return fmt::format("is not known; {} takes {}", last.parent.empty() ? "a case" : last.parent,
                     fmt::join(known, ", "));
}

std::vector<std::string_view> keys_below(std::string_view pattern) {
  std::vector<std::string_view> keys;
  for (const CaseKey& key : case_keys()) {
    const auto slash = key.pattern.rfind('/');
    if (slash != std::string_view::npos && key.pattern.substr(0, slash) == pattern)
      keys.push_back(key.pattern.substr(slash + 1));
  }
  return keys;
}

std::span<const RivalKeys> rival_keys() { return kRivals; }

bool are_rivals(std::string_view pointer, std::string_view other) {
  return std::ranges::any_of(kRivals, [&](const RivalKeys& pair) {
    return (pair.first == pointer && pair.second == other) || (pair.first == other && pair.second == pointer);
  });
}

std::span<const FactorName> factor_names() { return kFactors; }

std::optional<std::string> factor_pointer(std::string_view name) {
  const auto found = std::ranges::find(kFactors, name, &FactorName::name);
  if (found != kFactors.end()) return std::string(found->pointer);
  const CaseKey* key = find_case_key(name);
  if (key == nullptr || (key->kind != KeyKind::number && key->kind != KeyKind::integer)) return std::nullopt;
  return std::string(name);
}

std::string factor_rule(std::string_view name) {
  if (name.starts_with('/')) {
    return find_case_key(name) == nullptr ? unknown_key_rule(name)
                                          : "is not a number of a case, so it cannot be a factor";
  }
  const std::string as_pointer = "/" + std::string(name);
  if (name.find('/') != std::string_view::npos && find_case_key(as_pointer) != nullptr)
    return "is not a factor; did you mean \"" + as_pointer + "\"?";
  std::vector<std::string_view> names;
  names.reserve(kFactors.size());
  for (const FactorName& factor : kFactors) names.push_back(factor.name);
  const std::string suggestion = did_you_mean(name, names);
  return suggestion.empty() ? fmt::format("is not a factor: use one of {} or a JSON pointer to a number",
                                          fmt::join(names, ", "))
                            : "is not a factor" + suggestion;
}

}  // namespace repose
