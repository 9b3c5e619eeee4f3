#include "sweep/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/did_you_mean.hpp"
#include "engine/scene/tidy_path.hpp"
#include "sweep/factor.hpp"

namespace repose::sweep {

namespace {

using Json = CaseDocument::Json;

constexpr double kMostChartReplicates = 1e4;
constexpr const char* kChart = "/chart";

class LadderReader {
 public:
  LadderReader(const CaseDocument& document, Faults& faults) : document_(document), faults_(faults) {}

  Ladder read() {
    Ladder ladder;
    ladder.reference.name = kReference;
    const Json* chart = document_.find(kChart);
    if (chart == nullptr || !chart->is_object()) {
      fault(kChart, chart == nullptr ? "is missing: the case has no ladder to chart" : "must be an object");
      return ladder;
    }
    check_keys(kChart, *chart,
               {"reference", "working_point", "rungs", "frictions", "replicates", "rung_replicates", "seed"});
    ladder.reference.set = read_overrides(std::string(kChart) + "/reference", false);
    ladder.has_working_point = chart->contains("working_point");
    if (ladder.has_working_point)
      ladder.rungs.push_back(on_working_point(read_overrides(std::string(kChart) + "/working_point", true),
                                              {kWorkingPoint, {}}));
    read_rungs(ladder);
    read_frictions(ladder);
    ladder.replicates = static_cast<int>(read_integer("replicates", 5, 2, kMostChartReplicates));
    ladder.rung_replicates =
        static_cast<int>(read_integer("rung_replicates", ladder.replicates, 2, kMostChartReplicates));
    if (ladder.rung_replicates % ladder.replicates != 0)
      fault(std::string(kChart) + "/rung_replicates",
            fmt::format("must be a multiple of replicates, {}", ladder.replicates));
    ladder.seed = static_cast<std::uint64_t>(read_integer("seed", 1, 0, 0x1p53 - 1.0));
    return ladder;
  }

 private:
  void fault(const std::string& place, const std::string& rule) {
    const Json* value = document_.find(place);
    faults_.add(document_.source(place), place, value == nullptr ? "" : shown(*value), rule);
  }

  void check_keys(const std::string& place, const Json& object, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : object.items())
      if (std::ranges::find(known, key) == known.end())
        fault(pointer_to(place, key), "is not known here" + did_you_mean(key, known));
  }

  std::int64_t read_integer(const char* key, std::int64_t otherwise, std::int64_t low, double high) {
    const std::string place = pointer_to(kChart, key);
    const Json* value = document_.find(place);
    if (value == nullptr) return otherwise;
    const double number = value->is_number() ? value->get<double>() : std::nan("");
    if (number >= static_cast<double>(low) && number <= high && number == std::floor(number))
      return static_cast<std::int64_t>(number);
    fault(place, fmt::format("must be an integer from {} to {:.0f}", low, high));
    return otherwise;
  }

  std::vector<Override> read_overrides(const std::string& place, bool required) {
    const Json* object = document_.find(place);
    if (object == nullptr && !required) return {};
    if (object == nullptr || !object->is_object() || (required && object->empty())) {
      fault(place, required ? "must be an object with at least one JSON pointer into the case and its value"
                            : "must be an object of JSON pointers into the case and their values");
      return {};
    }
    std::vector<Override> overrides;
    for (const auto& [pointer, value] : object->items()) {
      const std::string here = pointer_to(place, pointer);
      if (const std::string rule = objection_to(pointer); !rule.empty())
        fault(here, rule);
      else
        overrides.push_back({pointer, value, here});
    }
    for (const RivalKeys& pair : rival_keys())
      if (object->contains(pair.first) && object->contains(pair.second) &&
          !object->at(std::string(pair.first)).is_null() && !object->at(std::string(pair.second)).is_null())
        fault(pointer_to(place, pair.second), fmt::format("excludes {} beside it", pair.first));
    return overrides;
  }

  /// Why a rung cannot set what a pointer leads to, or "".
  static std::string objection_to(const std::string& pointer) {
    if (!pointer.starts_with('/')) return "must be a JSON pointer into the case, such as \"/numerics/…\"";
    const CaseKey* key = find_case_key(pointer);
    if (key == nullptr) return unknown_key_rule(pointer);
    const std::string_view top = std::string_view(pointer).substr(0, pointer.find('/', 1));
    for (const char* own : {"/particles", "/walls", "/contact", "/test", "/numerics", "/measure"})
      if (top == own) return {};
    return "cannot be set by a ladder: it is not of the test";
  }

  void read_rungs(Ladder& ladder) {
    const std::string place = std::string(kChart) + "/rungs";
    const Json* rungs = document_.find(place);
    const bool may_be_empty = ladder.has_working_point || document_.source(place) == kDefaultLadder;
    if (rungs == nullptr || !rungs->is_array() || (rungs->empty() && !may_be_empty))
      return fault(place, rungs == nullptr ? "is missing" : "must be a list of at least one rung");
    const Variant working_point = ladder.has_working_point ? ladder.rungs.front() : Variant();
    std::vector<std::string> names = {kReference};
    if (ladder.has_working_point) names.emplace_back(kWorkingPoint);
    for (std::size_t i = 0; i < rungs->size(); ++i) {
      const std::string here = fmt::format("{}/{}", place, i);
      const Json& rung = (*rungs)[i];
      if (!rung.is_object()) {
        fault(here, "must be an object with a name and what it sets");
        continue;
      }
      check_keys(here, rung, {"name", "set"});
      const bool named = rung.contains("name") && rung["name"].is_string() && rung["name"] != "";
      const std::string name = named ? rung["name"].get<std::string>() : "";
      if (!named) fault(here + "/name", "must be a text that is not empty");
      if (std::ranges::find(names, name) != names.end())
        fault(here + "/name", name == kReference      ? "is the name of what rungs are compared with"
                              : name == kWorkingPoint ? "is the name of what rungs stand on"
                                                      : "stands in this ladder twice");
      if (named) names.push_back(name);
      ladder.rungs.push_back(
          on_working_point(working_point.set, {name, read_overrides(here + "/set", true)}));
    }
  }

  void read_frictions(Ladder& ladder) {
    const std::string place = std::string(kChart) + "/frictions";
    const Json* sets = document_.find(place);
    if (sets == nullptr || !sets->is_array() || sets->empty())
      return fault(place, sets == nullptr ? "is missing" : "must be a list of at least one set of frictions");
    for (std::size_t i = 0; i < sets->size(); ++i)
      read_friction_set((*sets)[i], fmt::format("{}/{}", place, i), ladder);
  }

  void read_friction_set(const Json& set, const std::string& here, Ladder& ladder) {
    if (!set.is_object() || set.empty()) return fault(here, "must be an object of factors and their values");
    std::vector<std::string> names;
    for (const auto& [name, value] : set.items()) {
      names.push_back(name);
      if (!factor_pointer(name)) fault(pointer_to(here, name), factor_rule(name));
      if (!value.is_number()) return fault(pointer_to(here, name), "must be a number");
    }
    std::ranges::sort(names);
    if (ladder.friction_names.empty()) ladder.friction_names = names;
    if (names != ladder.friction_names)
      return fault(here, fmt::format("must give the factors of the first set: {}",
                                     fmt::join(ladder.friction_names, ", ")));
    std::vector<double> values;
    for (const std::string& name : names) values.push_back(set.at(name).get<double>());
    if (std::ranges::find(ladder.frictions, values) != ladder.frictions.end())
      return fault(here, "stands in this list twice");
    ladder.frictions.push_back(std::move(values));
  }

  const CaseDocument& document_;
  Faults& faults_;
};

bool is_shape_path(const std::string& pointer) {
  const CaseKey* key = find_case_key(pointer);
  return key != nullptr &&
         (key->pattern == "/particles/shapes/*/clump" || key->pattern == "/particles/shapes/*/mesh");
}

/// Calls visit(value, place) for each path in a value that stands at `place` and is meant for `pointer`.
template <class Value, class Visit>
void for_each_path(Value& value, const std::string& pointer, const std::string& place, const Visit& visit) {
  if (value.is_string() && is_shape_path(pointer)) return visit(value, place);
  if (!value.is_structured()) return;
  for (auto entry = value.begin(); entry != value.end(); ++entry) {
    const std::string key =
        value.is_object() ? entry.key() : std::to_string(static_cast<std::size_t>(entry - value.begin()));
    for_each_path(*entry, pointer_to(pointer, key), pointer_to(place, key), visit);
  }
}

}  // namespace

Variant on_working_point(std::span<const Override> working_point, Variant variant) {
  std::vector<Override> set;
  for (const Override& shared : working_point) {
    const bool replaced = std::ranges::any_of(variant.set, [&](const Override& own) {
      return is_or_is_below(shared.pointer, own.pointer) ||
             (are_rivals(shared.pointer, own.pointer) && !own.value.is_null());
    });
    if (!replaced) set.push_back(shared);
  }
  variant.shared = set.size();
  set.insert(set.end(), variant.set.begin(), variant.set.end());
  variant.set = std::move(set);
  return variant;
}

Ladder read_ladder(const CaseDocument& document, Faults& faults) {
  return LadderReader(document, faults).read();
}

std::vector<std::string> shape_paths(const CaseDocument& document) {
  std::vector<std::string> places;
  const auto note = [&](const Json&, const std::string& place) { places.push_back(place); };
  const auto walk_overrides = [&](const std::string& place) {
    const Json* set = document.find(place);
    if (set == nullptr || !set->is_object()) return;
    for (const auto& [pointer, value] : set->items())
      for_each_path(value, pointer, pointer_to(place, pointer), note);
  };
  if (const Json* shapes = document.find("/particles/shapes"))
    for_each_path(*shapes, "/particles/shapes", "/particles/shapes", note);
  walk_overrides("/chart/reference");
  walk_overrides("/chart/working_point");
  if (const Json* rungs = document.find("/chart/rungs"); rungs != nullptr && rungs->is_array())
    for (std::size_t i = 0; i < rungs->size(); ++i) walk_overrides(fmt::format("/chart/rungs/{}/set", i));
  return places;
}

Json with_absolute_paths(const CaseDocument& document, const Override& override) {
  Json value = override.value;
  for_each_path(value, override.pointer, override.place, [&](Json& path, const std::string& place) {
    path = tidy(std::filesystem::absolute(document.resolve(place, path.get<std::string>()))).string();
  });
  return value;
}

}  // namespace repose::sweep
