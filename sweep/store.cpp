#include "sweep/store.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <type_traits>

#include "engine/base/input_error.hpp"
#include "sweep/flanks_json.hpp"
#include "sweep/sqlite.hpp"

namespace repose::sweep {

namespace {

constexpr int kApplicationId = 0x5265706f;  // "Repo" in the header of the file
/// 1: the first. 2: warnings, mass_lost_kg, reaches_edge and the diagnosis of the motion. 3: variant.
constexpr int kSchema = 3;

/// Names and types of the columns, and how they are bound and read: all from visit_columns.
template <class Value>
const char* sql_type() {
  if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, FactorValues>)
    return "TEXT NOT NULL";
  else if constexpr (std::is_same_v<Value, std::optional<double>>)
    return "REAL";
  else if constexpr (std::is_same_v<Value, double>)
    return "REAL NOT NULL";
  else if constexpr (std::is_same_v<Value, std::optional<int>> ||
                     std::is_same_v<Value, std::optional<std::int64_t>>)
    return "INTEGER";
  else
    return "INTEGER NOT NULL";
}

/// "angle_deg REAL", one a column.
std::vector<std::string> column_definitions() {
  std::vector<std::string> definitions;
  StoredRun run;
  visit_columns(run, [&](const char* name, const auto& value) {
    definitions.push_back(fmt::format("{} {}", name, sql_type<std::decay_t<decltype(value)>>()));
  });
  return definitions;
}

std::string create_runs_table() {
  std::string columns;
  for (const std::string& definition : column_definitions())
    columns += (columns.empty() ? "" : ", ") + definition;
  return fmt::format("CREATE TABLE IF NOT EXISTS runs ({}, PRIMARY KEY (run_key))", columns);
}

std::string column_names() {
  std::string names;
  StoredRun run;
  visit_columns(
      run, [&](const char* name, const auto&) { names += (names.empty() ? "" : ", ") + std::string(name); });
  return names;
}

struct Binder {
  Statement& statement;
  int index = 0;

  void operator()(const char*, const FactorValues& value) {
    statement.bind(index++, nlohmann::json(value).dump());
  }
  template <class Value>
  void operator()(const char*, const Value& value) {
    statement.bind(index++, value);
  }
};

struct Reader {
  const Statement& row;
  int index = 0;

  void operator()(const char*, FactorValues& value) {
    value = nlohmann::json::parse(row.text(index++)).get<FactorValues>();
  }
  void operator()(const char*, std::string& value) { value = row.text(index++); }
  void operator()(const char*, double& value) { value = row.real(index++); }
  void operator()(const char*, std::optional<double>& value) { value = row.optional_real(index++); }
  template <class Integer>
  void operator()(const char*, Integer& value) {
    value = static_cast<Integer>(row.integer(index++));
  }
  template <class Integer>
  void operator()(const char*, std::optional<Integer>& value) {
    value = row.is_null(index) ? std::nullopt : std::optional(static_cast<Integer>(row.integer(index)));
    ++index;
  }
};

std::vector<StoredRun> read_runs(const Database& database, const std::string& condition) {
  Statement rows = database.prepare(fmt::format("SELECT {} FROM runs {}", column_names(), condition));
  std::vector<StoredRun> runs;
  while (rows.step()) visit_columns(runs.emplace_back(), Reader{rows});
  return runs;
}

std::optional<StoredRun> read_run(const Database& database, const std::string& key) {
  Statement row = database.prepare(fmt::format("SELECT {} FROM runs WHERE run_key = ?", column_names()));
  row.bind(0, key);
  if (!row.step()) return std::nullopt;
  StoredRun run;
  visit_columns(run, Reader{row});
  return run;
}

/// Writes a run inside a transaction that the caller holds.
Store::Put put_row(Database& database, const StoredRun& run, const std::optional<Flanks>& flanks) {
  if (const auto present = read_run(database, run.run_key); present && (!present->failed() || run.failed())) {
    if (run.failed() || same_result(*present, run)) return Store::Put::already_there;
    return Store::Put::differs;
  }
  std::string marks = "?";
  for (const char c : column_names())
    if (c == ',') marks += ", ?";
  Statement insert =
      database.prepare(fmt::format("INSERT OR REPLACE INTO runs ({}) VALUES ({})", column_names(), marks));
  visit_columns(run, Binder{insert});
  insert.run();
  if (flanks) {
    Statement profile = database.prepare("INSERT OR REPLACE INTO profiles (run_key, flanks) VALUES (?, ?)");
    profile.bind(0, run.run_key).bind(1, flanks_to_json(*flanks)).run();
  }
  return Store::Put::stored;
}

/// Two processes may come here at once: the second finds everything in place.
void create_tables(Database& database) {
  Transaction transaction(database);
  database.execute(create_runs_table());
  database.execute(
      "CREATE TABLE IF NOT EXISTS profiles (run_key TEXT PRIMARY KEY NOT NULL, flanks TEXT NOT NULL)");
  database.execute("CREATE TABLE IF NOT EXISTS study (case_text TEXT NOT NULL)");
  database.execute("INSERT INTO study SELECT '' WHERE NOT EXISTS (SELECT 1 FROM study)");
  database.execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.execute(fmt::format("PRAGMA user_version = {}", kSchema));
  transaction.commit();
}

/// Brings a study of an older version to this one's columns. Its runs keep what they have: a text that they
/// were made without is empty, a number is NULL.
void migrate(Database& database) {
  if (database.integer("PRAGMA user_version") >= kSchema) return;
  Transaction transaction(database);
  for (const std::string& definition : column_definitions()) {
    const std::string name = definition.substr(0, definition.find(' '));
    if (database.integer(
            fmt::format("SELECT count(*) FROM pragma_table_info('runs') WHERE name = '{}'", name)) > 0)
      continue;
    const bool text = definition.find("TEXT") != std::string::npos;
    database.execute(fmt::format("ALTER TABLE runs ADD COLUMN {}{}", definition, text ? " DEFAULT ''" : ""));
  }
  database.execute(fmt::format("PRAGMA user_version = {}", kSchema));
  transaction.commit();
}

/// Why this database cannot be used as a study, or "".
std::string objection_to(const Database& database) {
  if (database.integer("PRAGMA application_id") != kApplicationId)
    return "is a database of something else, not a study";
  if (const auto schema = database.integer("PRAGMA user_version"); schema > kSchema)
    return fmt::format("was written by a newer version of the program (schema {}, known: {})", schema,
                       kSchema);
  if (const std::string check = database.text("PRAGMA quick_check(1)"); check != "ok")
    return "is damaged (" + check + "): restore a copy, or sweep into a new folder";
  return {};
}

InputError refusal(const std::filesystem::path& file, const SqliteError& error) {
  const std::string reason = std::string(error.what()).substr(file.string().size() + 2);
  const auto refused = [&](const std::string& rule) {
    return InputError(Fault{file.string(), "", "", rule});
  };
  switch (error.code()) {
    case SQLITE_NOTADB:
      return refused("is not a study: " + reason);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return refused("is in use by another process: " + reason);
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_READONLY:
      return refused("cannot be opened: " + reason);
    default:
      return refused("is damaged (" + reason + "): restore a copy, or sweep into a new folder");
  }
}

/// Opens, creates if wanted, checks.
std::unique_ptr<Database> opened(const std::filesystem::path& folder, bool create) {
  const std::filesystem::path file = folder / kStudyFile;
  try {
    auto database = std::make_unique<Database>(file, create ? Database::Mode::create : Database::Mode::write);
    database->execute("PRAGMA synchronous = FULL");
    const bool empty = database->integer("SELECT count(*) FROM sqlite_master") == 0 &&
                       database->integer("PRAGMA application_id") == 0;
    if (empty && create) create_tables(*database);
    if (const std::string objection = objection_to(*database); !objection.empty())
      throw InputError(Fault{file.string(), "", "", objection});
    migrate(*database);
    return database;
  } catch (const SqliteError& error) {
    throw refusal(file, error);
  }
}

}  // namespace

Store::Store(std::unique_ptr<Database> database) : database_(std::move(database)) {}
Store::~Store() = default;
Store::Store(Store&& other) noexcept = default;
Store& Store::operator=(Store&& other) noexcept = default;

Store Store::open(const std::filesystem::path& folder) {
  if (!std::filesystem::is_regular_file(folder / kStudyFile))
    throw InputError(
        Fault{folder.string(), "", "", std::string("holds no study: there is no ") + kStudyFile + " in it"});
  return Store(opened(folder, false));
}

Store Store::open_or_create(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(Fault{folder.string(), "", "",
                           "cannot be a study's folder: " + (error ? error.message() : "it is a file")});
  return Store(opened(folder, true));
}

std::string Store::case_text() const { return database_->text("SELECT case_text FROM study"); }

void Store::set_case_text(const std::string& text) {
  database_->prepare("UPDATE study SET case_text = ?").bind(0, text).run();
}

Store::Put Store::put(const StoredRun& run, const std::optional<Flanks>& flanks) {
  Transaction transaction(*database_);
  const Put done = put_row(*database_, run, flanks);
  transaction.commit();
  return done;
}

std::vector<StoredRun> Store::runs() const {
  return read_runs(*database_, "ORDER BY point IS NULL, point, replicate, run_key");
}

std::optional<Flanks> Store::flanks(const std::string& run_key) const {
  Statement row = database_->prepare("SELECT flanks FROM profiles WHERE run_key = ?");
  row.bind(0, run_key);
  if (!row.step()) return std::nullopt;
  return flanks_from_json(row.text(0));
}

void Store::relabel(const std::unordered_map<std::string, Label>& labels) {
  Transaction transaction(*database_);
  database_->execute("UPDATE runs SET point = NULL");
  Statement update =
      database_->prepare("UPDATE runs SET point = ?, replicate = ?, variant = ? WHERE run_key = ?");
  for (const auto& [key, label] : labels) {
    update.bind(0, label.point).bind(1, label.replicate).bind(2, label.variant).bind(3, key);
    update.run();
  }
  transaction.commit();
}

std::vector<std::string> Store::take_from(const std::vector<const Store*>& others) {
  std::vector<std::string> conflicts;
  Transaction transaction(*database_);
  for (const Store* other : others) {
    for (const StoredRun& run : other->runs()) {
      if (put_row(*database_, run, other->flanks(run.run_key)) == Put::differs)
        conflicts.push_back(run.run_key);
    }
  }
  if (conflicts.empty()) transaction.commit();
  return conflicts;
}

std::string Store::file() const { return database_->file(); }

}  // namespace repose::sweep
