#include "chart/chosen_case.hpp"

#include "engine/base/json_file.hpp"
#include "engine/scene/tidy_path.hpp"

namespace repose::chart {

namespace {

namespace fs = std::filesystem;
using Json = CaseDocument::Json;

/// The way from a folder to a file as the system goes it: links in either are followed first.
std::string seen_from(const fs::path& folder, const fs::path& file) {
  return fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder)).string();
}

/// What turns one object into another when it is merged into it (RFC 7386): null for what is no longer there,
/// objects key by key, all else whole. Empty where they are equal.
Json patch_between(const Json& from, const Json& to) {
  Json patch = Json::object();
  for (const auto& [key, value] : from.items())
    if (!to.contains(key)) patch[key] = nullptr;
  for (const auto& [key, value] : to.items()) {
    const auto before = from.find(key);
    if (before == from.end())
      patch[key] = value;
    else if (value.is_object() && before->is_object()) {
      if (Json below = patch_between(*before, value); !below.empty()) patch[key] = std::move(below);
    } else if (value != *before)
      patch[key] = value;
  }
  return patch;
}

}  // namespace

Json chosen_case(const CaseDocument& document, const std::vector<sweep::Variant>& variants,
                 const fs::path& folder, const std::string& title) {
  CaseDocument chosen = document;
  for (const sweep::Variant& variant : variants)
    for (const sweep::Override& override : variant.set)
      chosen.set(override.pointer, override.value, override.place);

  Json given = document.json(), wanted = chosen.json();
  for (const char* own : {"title", "sweep", "chart"}) given.erase(own), wanted.erase(own);
  Json json = {{"base", seen_from(folder, document.file())}, {"title", title}};
  json.update(patch_between(given, wanted));
  for (const std::string& place : sweep::shape_paths(chosen)) {
    if (!place.starts_with("/particles/")) continue;
    if (Json* path = value_at(json, place))
      *path = seen_from(folder, chosen.resolve(place, chosen.find(place)->get<std::string>()));
  }
  return json;
}

}  // namespace repose::chart
