#include "sweep/same_case.hpp"

#include <array>

#include "engine/base/json_file.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/scene_reader.hpp"
#include "sweep/self_contained.hpp"

namespace repose::sweep {

namespace {

using Json = CaseDocument::Json;

constexpr std::array kFrictions = {"e_pp", "mu_s", "mu_r"};
constexpr const char* kComparison = "comparison";

/// A case without what may differ, its keys sorted.
nlohmann::json stripped(const Json& json) {
  nlohmann::json rest = nlohmann::json::parse(json.dump());
  for (const char* key : {"sweep", "chart", "title", "$schema"}) rest.erase(key);
  for (const char* name : kFrictions) {
    const nlohmann::json::json_pointer pointer(*factor_pointer(name));
    if (rest.contains(pointer)) rest.at(pointer.parent_pointer()).erase(pointer.back());
  }
  return rest;
}

/// Key of the scene with equal frictions, or "" where the case alone, without a point of its design, is no
/// scene.
std::string key_of(CaseDocument document) {
  Faults faults;
  try {
    for (const char* name : kFrictions) document.set(*factor_pointer(name), 0.5, kComparison);
    const Scene scene = read_scene(document, faults);
    return faults.empty() ? run_key(scene, 0) : std::string{};
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::vector<Fault> differences(const CaseDocument& of_study, const CaseDocument& given) {
  const Json given_json = self_contained(given, of_study.file().parent_path()).document.json();
  const nlohmann::json theirs = stripped(of_study.json());
  const nlohmann::json ours = stripped(given_json);
  if (theirs == ours) return {};
  if (const std::string key = key_of(of_study); !key.empty() && key == key_of(given)) return {};
  std::vector<Fault> faults;
  for (const auto& change : nlohmann::json::diff(theirs, ours)) {
    const auto pointer = change.at("path").get<std::string>();
    const auto* before = value_at(of_study.json(), pointer);
    const auto* now = value_at(given_json, pointer);
    faults.push_back({given.source(pointer), pointer, now != nullptr ? shown(*now) : "",
                      "differs from the case of the study, " +
                          (before != nullptr ? "where it is " + shown(*before) : "where it is not given") +
                          ": sweep another case into another folder"});
  }
  return faults;
}

}  // namespace repose::sweep
