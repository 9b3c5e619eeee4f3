#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "engine/base/input_error.hpp"
#include "engine/scene/case_document.hpp"
#include "engine/scene/names.hpp"

namespace repose {

/// A case whose keys, types and ranges have been checked against case_keys(). A value that broke a rule, and
/// whose fault is noted, reads as absent, so that no rule between values follows from it. Pointers are those
/// of the case.
class CheckedCase {
 public:
  /// Adds a fault for every key that is not known or is missing, every value of a wrong type or out of its
  /// range.
  CheckedCase(const CaseDocument& document, Faults& faults);

  /// Whether the case gives a value here, right or wrong.
  [[nodiscard]] bool given(std::string_view pointer) const { return document_.find(pointer) != nullptr; }

  /// Whether the case gives a value here that broke no rule of its own.
  [[nodiscard]] bool is_sound(const std::string& pointer) const { return sound(pointer) != nullptr; }

  /// The number at a pointer; nothing where it is absent, wrong or a word that stands for a number.
  [[nodiscard]] std::optional<double> number(const std::string& pointer) const;
  [[nodiscard]] double number_or(const std::string& pointer, double otherwise) const {
    return number(pointer).value_or(otherwise);
  }
  [[nodiscard]] std::optional<int> integer(const std::string& pointer) const;
  [[nodiscard]] std::optional<std::string> text(const std::string& pointer) const;
  /// Number of entries of a list, 0 where there is none.
  [[nodiscard]] std::size_t entries(const std::string& pointer) const;

  template <class Choice>
  [[nodiscard]] Choice choice_or(const std::string& pointer, Choice otherwise) const {
    const std::optional<std::string> name = text(pointer);
    return name ? choice_of<Choice>(*name).value_or(otherwise) : otherwise;
  }

  /// A fault of the value at a pointer, which may be absent.
  void fault(const std::string& pointer, const std::string& rule);
  void add(const InputError& error) { faults_.add(error); }
  [[nodiscard]] std::size_t fault_count() const { return faults_.list().size(); }
  [[nodiscard]] const CaseDocument& document() const { return document_; }

 private:
  using Json = CaseDocument::Json;
  void check(const Json& value, const std::string& pointer);
  void check_keys(const Json& object, const std::string& pointer);
  void check_number(const Json& value, const std::string& pointer);
  void check_text(const Json& value, const std::string& pointer);
  void refuse(const std::string& pointer, const std::string& rule);
  /// The value where it is given and right, else nullptr.
  [[nodiscard]] const Json* sound(const std::string& pointer) const;

  const CaseDocument& document_;
  Faults& faults_;
  std::set<std::string> wrong_;  ///< pointers whose values broke a rule
};

}  // namespace repose
