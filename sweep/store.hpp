#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/measure/heap_measurement.hpp"
#include "sweep/stored_run.hpp"

namespace repose::sweep {

class Database;

/// Name of the file in a study's folder.
inline constexpr const char* kStudyFile = "study.sqlite";

using Flanks = std::array<Flank, 4>;

/// study.sqlite: the case of a study and every finished run of it.
///
/// A run is written in a transaction of its own, with SQLite's rollback journal and full synchronisation:
/// what put() has returned for is there after a kill or a power cut, and a write that was cut short is rolled
/// back by the next opening. (The write-ahead log is not used, because it does not work on network disks.)
/// Several processes may write to one study; one thread at a time may use a Store.
class Store {
 public:
  /// Opens the study in a folder. Throws InputError: no study there, not a database, a database of something
  /// else, damaged, or written by a newer version.
  static Store open(const std::filesystem::path& folder);
  /// The same, and makes the folder and an empty study where there is none.
  static Store open_or_create(const std::filesystem::path& folder);
  ~Store();
  Store(Store&& other) noexcept;
  Store& operator=(Store&& other) noexcept;

  /// The case that the study was made from, as JSON text; empty in a new study.
  [[nodiscard]] std::string case_text() const;
  void set_case_text(const std::string& text);

  enum class Put { stored, already_there, differs };
  /// Stores a run, at once and durably. A `failed` record gives way to any other of its key, and is never
  /// written over one. `already_there`: the same result was stored before. `differs`: another result was
  /// stored for this key before; it is kept.
  Put put(const StoredRun& run, const std::optional<Flanks>& flanks = std::nullopt);

  /// All runs, by point, replicate and key; runs that the design no longer has come last.
  [[nodiscard]] std::vector<StoredRun> runs() const;
  /// The flanks of a run, with their profiles, or nothing.
  [[nodiscard]] std::optional<Flanks> flanks(const std::string& run_key) const;

  struct Label {
    int point = 0;
    int replicate = 0;
    std::string variant;
  };
  /// Numbers and names the runs by the design that is now the study's: those of these keys as given, all
  /// others without a point.
  void relabel(const std::unordered_map<std::string, Label>& labels);

  /// Takes over the runs of other studies, all or nothing.
  /// @return keys for which two studies hold different results; if there are any, nothing is taken.
  std::vector<std::string> take_from(const std::vector<const Store*>& others);

  [[nodiscard]] std::string file() const;

 private:
  explicit Store(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace repose::sweep
