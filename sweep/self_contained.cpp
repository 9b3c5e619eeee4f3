#include "sweep/self_contained.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sweep/ladder.hpp"
#include "sweep/study.hpp"

namespace repose::sweep {

namespace {

namespace fs = std::filesystem;
using Json = CaseDocument::Json;

/// Pointers of all paths in a case.
std::vector<std::string> paths_in(const CaseDocument& document) {
  std::vector<std::string> pointers = shape_paths(document);
  const Json* table = document.find("/sweep/table");
  if (table != nullptr && table->is_string()) pointers.push_back("/sweep/table");
  return pointers;
}

/// A file beside another that no other process or thread writes at the same time.
fs::path part_of(const fs::path& file) {
  static std::atomic<int> count = 0;
  return fmt::format("{}.part-{}-{}", file.string(), getpid(), ++count);
}

std::string content_of(const fs::path& file, const std::string& source, const std::string& pointer) {
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || fs::is_directory(file))
    throw InputError(Fault{source, pointer, "\"" + file.string() + "\"", "cannot be opened"});
  return content;
}

/// "p13-1f2e….json" for p13.json; a name that already ends in the hash of its content is kept.
std::string name_by_content(const fs::path& file, const std::string& content) {
  const std::string hash = fmt::format("-{:016x}", XXH3_64bits(content.data(), content.size()));
  std::string stem = file.stem().string();
  if (stem.ends_with(hash)) stem.resize(stem.size() - hash.size());
  return stem + hash + file.extension().string();
}

}  // namespace

SelfContained self_contained(const CaseDocument& document, const fs::path& folder) {
  Json json = document.json();
  std::vector<SelfContained::File> files;
  for (const std::string& pointer : paths_in(document)) {
    const fs::path from = document.resolve(pointer, document.find(pointer)->get<std::string>());
    const std::string content = content_of(from, document.source(pointer), pointer);
    const std::string to = std::string(kCaseFiles) + "/" + name_by_content(from, content);
    json.at(Json::json_pointer(pointer)) = to;
    const bool known =
        std::any_of(files.begin(), files.end(), [&](const auto& file) { return file.to == to; });
    if (!known) files.push_back({from, to});
  }
  return {CaseDocument::from_json(std::move(json), folder / kCaseFile), std::move(files)};
}

void copy_files(const SelfContained& self_contained, const fs::path& folder) {
  for (const SelfContained::File& file : self_contained.files) {
    const fs::path to = folder / file.to;
    if (fs::exists(to)) continue;
    fs::create_directories(to.parent_path());
    const fs::path part = part_of(to);
    fs::copy_file(file.from, part, fs::copy_options::overwrite_existing);
    fs::rename(part, to);
  }
}

void replace_file(const fs::path& named, const std::string& text) {
  std::error_code error;
  const fs::path file = fs::exists(named, error) ? fs::canonical(named) : named;  // where a link leads
  // What is there and no regular file (a terminal, a pipe, a device) is written to, not replaced.
  const bool in_place = fs::exists(file, error) && !fs::is_regular_file(file);
  const fs::path part = in_place ? file : part_of(file);
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    if (!in_place) fs::remove(part, error);
    throw std::runtime_error(part.string() + ": cannot be written");
  }
  if (!in_place) fs::rename(part, file);
}

}  // namespace repose::sweep
