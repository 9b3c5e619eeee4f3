#include "chart/chosen_case.hpp"

#include "engine/base/json_file.hpp"

namespace repose::chart {

namespace {

namespace fs = std::filesystem;
using Json = CaseDocument::Json;

std::string seen_from(const fs::path& folder, const fs::path& file) {
  return fs::absolute(file)
      .lexically_normal()
      .lexically_relative(fs::absolute(folder).lexically_normal())
      .string();
}

/// The pointer itself, or that of the list that it leads into.
std::string whole_of(const CaseDocument& document, const std::string& pointer) {
  std::string part;
  const auto parts = pointer_parts(pointer);
  for (const std::string& name : *parts) {
    part = pointer_to(part, name);
    const Json* value = document.find(part);
    if (value != nullptr && value->is_array()) return part;
  }
  return pointer;
}

}  // namespace

Json chosen_case(const CaseDocument& document, const std::vector<sweep::Variant>& variants,
                 const fs::path& folder, const std::string& title) {
  CaseDocument chosen = document;
  for (const sweep::Variant& variant : variants)
    for (const sweep::Override& override : variant.set)
      chosen.set(override.pointer, override.value, "the chart");

  CaseDocument moved = chosen;
  for (const std::string& place : sweep::shape_paths(chosen)) {
    if (!place.starts_with("/particles/")) continue;
    const fs::path file = chosen.resolve(place, chosen.find(place)->get<std::string>());
    moved.set(place, seen_from(folder, file), "the chart");
  }
  Json json = {{"base", seen_from(folder, document.file())}, {"title", title}};
  for (const sweep::Variant& variant : variants) {
    for (const sweep::Override& override : variant.set) {
      const std::string pointer = whole_of(chosen, override.pointer);
      const Json* value = moved.find(pointer);
      json[Json::json_pointer(pointer)] = value == nullptr ? Json() : *value;
    }
  }
  return json;
}

}  // namespace repose::chart
