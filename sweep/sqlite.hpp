#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace repose::sweep {

/// SQLite refused: the file, what it said and its primary result code.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(const std::string& file, const std::string& message, int code)
      : std::runtime_error(file + ": " + message), code_(code) {}
  /// SQLITE_NOTADB, SQLITE_CORRUPT, SQLITE_FULL …
  [[nodiscard]] int code() const { return code_; }

 private:
  int code_;
};

/// A prepared statement. Parameters and columns count from 0. Every call throws SqliteError where SQLite
/// refuses.
class Statement {
 public:
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, int value) { return bind(parameter, std::int64_t{value}); }
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, const std::string& value);
  template <class Value>
  Statement& bind(int parameter, const std::optional<Value>& value) {
    return value ? bind(parameter, *value) : *this;  // an unbound parameter is NULL
  }

  /// Runs to the next row; false when there is none.
  bool step();
  /// Runs to the end and makes ready for the next use, all parameters NULL.
  void run();

  [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(get(), column); }
  [[nodiscard]] double real(int column) const { return sqlite3_column_double(get(), column); }
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] bool is_null(int column) const { return sqlite3_column_type(get(), column) == SQLITE_NULL; }
  [[nodiscard]] std::optional<double> optional_real(int column) const;
  [[nodiscard]] std::optional<int> optional_int(int column) const;

 private:
  friend class Database;
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Statement(sqlite3_stmt* statement, std::string file) : statement_(statement), file_(std::move(file)) {}
  [[nodiscard]] sqlite3_stmt* get() const { return statement_.get(); }
  void check(int code) const;

  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
  std::string file_;
};

/// A connection to one database file, for one thread at a time.
class Database {
 public:
  enum class Mode { read, write, create };
  /// Waits up to a minute for another process that is writing. Throws SqliteError.
  Database(const std::filesystem::path& file, Mode mode);

  void execute(const std::string& sql);
  [[nodiscard]] Statement prepare(const std::string& sql) const;
  /// First column of the first row; 0 or "" where there is none.
  [[nodiscard]] std::int64_t integer(const std::string& sql) const;
  [[nodiscard]] std::string text(const std::string& sql) const;
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  struct Close {
    void operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> connection_;
};

/// All or nothing: rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(&database) { database.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
};

}  // namespace repose::sweep
