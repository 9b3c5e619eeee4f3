#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

#include "engine/base/input_error.hpp"

namespace repose {

/// A case as JSON: one file with everything that it inherits, and the values set on top. It knows for every
/// value where it came from, so that a message names the right file and a path is found beside the file in
/// which it stands.
///
/// Inheritance (RFC 7386, JSON Merge Patch): the key "base" of a file is the path of another case, relative
/// to the file itself; objects merge key by key, everything else replaces what is inherited, null removes it.
/// Of two keys that exclude each other (rival_keys()), the one that a file gives removes the other that it
/// inherits.
class CaseDocument {
 public:
  using Json = nlohmann::ordered_json;

  /// What messages name as the origin of a value given with --set.
  static constexpr const char* kCommandLine = "--set";

  /// Reads a case and everything that it inherits. Values are not checked here (read_scene() does).
  /// Throws InputError: a file missing, not JSON or not an object, "base" not a text, files that inherit from
  /// each other in a circle.
  static CaseDocument load(const std::filesystem::path& file);

  /// A case that stands in no file; relative paths in it are found from the folder of `name`.
  static CaseDocument from_json(Json json, const std::filesystem::path& name);

  /// The whole case, without "base".
  [[nodiscard]] const Json& json() const { return json_; }
  /// The file that load() was given.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// The value at a pointer, or nullptr.
  [[nodiscard]] const Json* find(std::string_view pointer) const;
  /// The file (or "--set", or what set() was told) that a value came from. For a pointer that leads nowhere:
  /// the origin of the last value on its way.
  [[nodiscard]] const std::string& source(std::string_view pointer) const;
  /// A path that stands at a pointer, found from the folder of its file; from the folder of file() for values
  /// that came from no file.
  [[nodiscard]] std::filesystem::path resolve(std::string_view pointer, const std::string& path) const;

  /// Sets one value (null removes it), and remembers its origin for messages. Costs no reading of files: a
  /// sweep copies a document and sets its factors for every point. Lists keep their length. Throws
  /// InputError, and leaves the document as it was: a case knows no such key, or there is no such entry of a
  /// list.
  void set(const std::string& pointer, Json value, const std::string& source);

  /// Sets KEY=VALUE of a command line; KEY is a JSON pointer or a factor's name, VALUE is JSON or, where it
  /// is not, a text. Faults are added, and the document stays as it was.
  void set_from_command_line(const std::string& assignment, Faults& faults);

 private:
  void merge_at(Json& target, const Json& layer, const std::string& pointer, const std::string& source);
  void assign(Json& target, Json value, const std::string& pointer, const std::string& source);
  void record(const Json& value, const std::string& pointer, const std::string& source);
  void forget(const std::string& pointer);
  void remove_rivals(const std::string& pointer, const Json& given, const std::string& source);
  void remove(const std::string& pointer);

  std::filesystem::path file_;
  std::set<std::string, std::less<>> files_;  ///< of the chain of inheritance
  Json json_ = Json::object();
  std::map<std::string, std::string, std::less<>> sources_{
      {"", ""}};  ///< of every value that is not an entry of a list
};

}  // namespace repose
