#include "engine/scene/case_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>
#include <vector>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/tidy_path.hpp"

namespace repose {

namespace {

using Json = CaseDocument::Json;

struct Layer {
  std::string file;
  Json json;
};

/// Where two paths name one file they are equal after this.
std::filesystem::path identity(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::path canonical = std::filesystem::weakly_canonical(file, error);
  return error ? std::filesystem::absolute(file).lexically_normal() : canonical;
}

/// The file that a layer inherits from, with "base" taken out of it; "" where there is none.
std::filesystem::path take_base(Layer& layer) {
  const auto base = layer.json.find("base");
  if (base == layer.json.end()) return {};
  if (!base->is_string() || base->get<std::string>().empty())
    throw InputError({layer.file, "/base", shown(*base), "must be the path of a case"});
  const std::filesystem::path file =
      tidy(std::filesystem::path(layer.file).parent_path() / base->get<std::string>());
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError({layer.file, "/base", shown(*base), "cannot be opened: " + file.string()});
  layer.json.erase("base");
  return file;
}

/// The case and what it inherits, the most general last.
std::vector<Layer> layers_of(const std::filesystem::path& file) {
  std::vector<Layer> layers;
  std::vector<std::filesystem::path> seen;
  for (std::filesystem::path next = file; !next.empty();) {
    seen.push_back(identity(next));
    layers.push_back({next.string(), read_json(next)});
    Layer& layer = layers.back();
    if (!layer.json.is_object()) throw InputError({layer.file, "", shown(layer.json), "must be an object"});
    next = take_base(layer);
    if (!next.empty() && std::ranges::find(seen, identity(next)) != seen.end())
      throw InputError({layer.file, "/base", "\"" + next.string() + "\"",
                        "inherits from itself: " + next.string() + " is reached again"});
  }
  return layers;
}

std::string parent_of(std::string_view pointer) { return std::string(pointer.substr(0, pointer.rfind('/'))); }

/// What a merge makes of a value that meets none: in it, null says that a key is not there (RFC 7386).
Json without_nulls(const Json& value) {
  if (!value.is_object()) return value;
  Json kept = Json::object();
  for (const auto& [key, below] : value.items())
    if (!below.is_null()) kept[key] = without_nulls(below);
  return kept;
}

/// Why the case has no place for a value at this pointer, whose key is known; "" where it has. Objects that
/// are missing on the way can be made, entries of lists cannot.
std::string no_place(const Json& root, const std::string& pointer) {
  const std::string parent = parent_of(pointer);
  const Json* holder = value_at(root, parent);
  const CaseKey* key = find_case_key(parent);
  if (holder == nullptr) {
    if (key->kind == KeyKind::list) return fmt::format("cannot be set: the case has no list {}", parent);
    return no_place(root, parent);
  }
  if (holder->is_object() || holder->is_null()) return "";
  if (!holder->is_array()) return fmt::format("cannot be set: {} is not an object", parent);
  const auto index = list_index(pointer.substr(parent.size() + 1));
  if (index && *index < holder->size()) return "";
  return fmt::format("cannot be set: {} has {} {}, counted from 0", parent, holder->size(),
                     holder->size() == 1 ? "entry" : "entries");
}

}  // namespace

CaseDocument CaseDocument::load(const std::filesystem::path& file) {
  CaseDocument document;
  document.file_ = file;
  const std::vector<Layer> layers = layers_of(file);
  for (const Layer& layer : layers | std::views::reverse) {
    document.files_.insert(layer.file);
    document.merge_at(document.json_, layer.json, "", layer.file);
  }
  return document;
}

CaseDocument CaseDocument::from_json(Json json, const std::filesystem::path& name) {
  CaseDocument document;
  document.file_ = name;
  document.files_.insert(name.string());
  document.json_ = std::move(json);
  document.record(document.json_, "", name.string());
  return document;
}

const Json* CaseDocument::find(std::string_view pointer) const { return value_at(json_, pointer); }

const std::string& CaseDocument::source(std::string_view pointer) const {
  for (;;) {
    const auto found = sources_.find(pointer);
    if (found != sources_.end()) return found->second;
    const auto slash = pointer.rfind('/');
    pointer = slash == std::string_view::npos ? std::string_view() : pointer.substr(0, slash);
  }
}

std::filesystem::path CaseDocument::resolve(std::string_view pointer, const std::string& path) const {
  const std::string& origin = source(pointer);
  const std::filesystem::path beside = files_.contains(origin) ? std::filesystem::path(origin) : file_;
  return tidy(beside.parent_path() / path);
}

void CaseDocument::merge_at(Json& target, const Json& layer, const std::string& pointer,
                            const std::string& source) {
  sources_[pointer] = source;
  for (const auto& [key, value] : layer.items()) {
    const std::string below = pointer_to(pointer, key);
    const auto inherited = target.find(key);
    if (value.is_null()) {
      target.erase(key);
      forget(below);
    } else if (inherited == target.end()) {
      assign(target[key], without_nulls(value), below, source);
    } else if (value.is_object() && inherited->is_object()) {
      merge_at(*inherited, value, below, source);
    } else {
      assign(*inherited, without_nulls(value), below, source);
    }
  }
  for (const auto& [key, value] : layer.items()) remove_rivals(pointer_to(pointer, key), value, source);
}

void CaseDocument::assign(Json& target, Json value, const std::string& pointer, const std::string& source) {
  target = std::move(value);
  forget(pointer);
  record(target, pointer, source);
}

void CaseDocument::record(const Json& value, const std::string& pointer, const std::string& source) {
  sources_[pointer] = source;
  if (!value.is_object()) return;
  for (const auto& [key, below] : value.items()) record(below, pointer_to(pointer, key), source);
}

void CaseDocument::forget(const std::string& pointer) {
  const std::string prefix = pointer + "/";
  auto first = sources_.lower_bound(prefix);
  auto last = first;
  while (last != sources_.end() && last->first.starts_with(prefix)) ++last;
  sources_.erase(first, last);
  sources_.erase(pointer);
}

void CaseDocument::remove(const std::string& pointer) {
  Json* holder = value_at(json_, parent_of(pointer));
  if (holder == nullptr || !holder->is_object()) return;
  holder->erase(pointer_parts(pointer)->back());
  forget(pointer);
}

void CaseDocument::remove_rivals(const std::string& pointer, const Json& given, const std::string& source) {
  if (given.is_null()) return;
  for (const RivalKeys& pair : rival_keys()) {
    if (pointer != pair.first && pointer != pair.second) continue;
    const std::string rival(pointer == pair.first ? pair.second : pair.first);
    if (find(rival) != nullptr && this->source(rival) != source) remove(rival);
  }
}

void CaseDocument::set(const std::string& pointer, Json value, const std::string& source) {
  const auto refuse = [&](const std::string& rule) {
    throw InputError({source, pointer, shown(value), rule});
  };
  if (pointer.empty() || find_case_key(pointer) == nullptr) refuse(unknown_key_rule(pointer));
  if (pointer == "/base") refuse("cannot be set: what a case inherits is read before");
  if (const std::string reason = no_place(json_, pointer); !reason.empty()) refuse(reason);
  if (value.is_null()) {
    const Json* holder = find(parent_of(pointer));
    if (holder != nullptr && holder->is_array())
      refuse("must be a value: an entry of a list cannot be removed");
    return remove(pointer);
  }

  Json* target = &json_;
  const auto parts = pointer_parts(pointer);
  for (const std::string& part : *parts)
    target = target->is_array() ? &(*target)[*list_index(part)] : &(*target)[part];
  assign(*target, std::move(value), pointer, source);
  remove_rivals(pointer, *target, source);
}

void CaseDocument::set_from_command_line(const std::string& assignment, Faults& faults) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    faults.add(kCommandLine, "", assignment, "must be KEY=VALUE");
    return;
  }
  const std::string key = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);
  if (!key.starts_with('/') && !factor_pointer(key)) {
    faults.add(kCommandLine, key, text, factor_rule(key));
    return;
  }
  try {
    Json value = Json::accept(text) ? parse_json(text, kCommandLine) : Json(text);
    set(factor_pointer(key).value_or(key), std::move(value), kCommandLine);
  } catch (const InputError& error) {
    faults.add(error);
  }
}

}  // namespace repose
