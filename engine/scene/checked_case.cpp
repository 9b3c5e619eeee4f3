#include "engine/scene/checked_case.hpp"

#include <cmath>
#include <limits>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/did_you_mean.hpp"

namespace repose {

CheckedCase::CheckedCase(const CaseDocument& document, Faults& faults)
    : document_(document), faults_(faults) {
  check(document.json(), "");
}

void CheckedCase::fault(const std::string& pointer, const std::string& rule) {
  const Json* value = document_.find(pointer);
  faults_.add(document_.source(pointer), pointer, value == nullptr ? "" : shown(*value), rule);
}

void CheckedCase::refuse(const std::string& pointer, const std::string& rule) {
  wrong_.insert(pointer);
  fault(pointer, rule);
}

void CheckedCase::check(const Json& value, const std::string& pointer) {
  const CaseKey& key = *find_case_key(pointer);
  switch (key.kind) {
    case KeyKind::object:
      if (!value.is_object()) return refuse(pointer, key.type_rule());
      return check_keys(value, pointer);
    case KeyKind::list:
      if (!value.is_array() || !key.range.holds(static_cast<double>(value.size())))
        return refuse(pointer, key.type_rule());
      for (std::size_t i = 0; i < value.size(); ++i) check(value[i], pointer_to(pointer, std::to_string(i)));
      return;
    case KeyKind::number:
    case KeyKind::integer:
      return check_number(value, pointer);
    case KeyKind::text:
      return check_text(value, pointer);
    case KeyKind::marker:
      if (value != Json(true)) refuse(pointer, key.type_rule());
      return;
    case KeyKind::anything:
      return;
  }
}

void CheckedCase::check_keys(const Json& object, const std::string& pointer) {
  for (const auto& [name, value] : object.items()) {
    const std::string below = pointer_to(pointer, name);
    if (find_case_key(below) == nullptr)
      refuse(below, unknown_key_rule(below));
    else
      check(value, below);
  }
  const std::string pattern(find_case_key(pointer)->pattern);
  for (const std::string_view name : keys_below(pattern)) {
    const std::string below = pointer_to(pointer, name);
    if (find_case_key(below)->required && !object.contains(name)) fault(below, "is missing");
  }
}

void CheckedCase::check_number(const Json& value, const std::string& pointer) {
  const CaseKey& key = *find_case_key(pointer);
  if (value.is_string() && std::ranges::find(key.choices, value.get<std::string>()) != key.choices.end())
    return;
  if (!value.is_number()) return refuse(pointer, key.type_rule());
  const double number = value.get<double>();
  const bool whole = std::floor(number) == number && std::abs(number) <= std::numeric_limits<int>::max();
  if (!std::isfinite(number))
    refuse(pointer, "must be a finite number");
  else if (!key.range.holds(number))
    refuse(pointer, "must be " + key.range.text());
  else if (key.kind == KeyKind::integer && !whole)
    refuse(pointer, key.type_rule());
}

void CheckedCase::check_text(const Json& value, const std::string& pointer) {
  const CaseKey& key = *find_case_key(pointer);
  if (!value.is_string()) return refuse(pointer, key.type_rule());
  const auto text = value.get<std::string>();
  if (!key.choices.empty() && std::ranges::find(key.choices, text) == key.choices.end())
    refuse(pointer, key.type_rule() + did_you_mean(text, key.choices));
}

const CheckedCase::Json* CheckedCase::sound(const std::string& pointer) const {
  return wrong_.contains(pointer) ? nullptr : document_.find(pointer);
}

std::optional<double> CheckedCase::number(const std::string& pointer) const {
  const Json* value = sound(pointer);
  if (value == nullptr || !value->is_number()) return std::nullopt;
  return value->get<double>();
}

std::optional<int> CheckedCase::integer(const std::string& pointer) const {
  const std::optional<double> value = number(pointer);
  if (!value) return std::nullopt;
  return static_cast<int>(*value);
}

std::optional<std::string> CheckedCase::text(const std::string& pointer) const {
  const Json* value = sound(pointer);
  if (value == nullptr || !value->is_string()) return std::nullopt;
  return value->get<std::string>();
}

std::size_t CheckedCase::entries(const std::string& pointer) const {
  const Json* value = sound(pointer);
  return value != nullptr && value->is_array() ? value->size() : 0;
}

}  // namespace repose
