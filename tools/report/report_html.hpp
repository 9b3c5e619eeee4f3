#pragma once

#include <filesystem>
#include <string>

namespace repose::report {

/// `<`, `>`, `&`, `"` and `'` as entities: any text may then stand in a page or in an attribute.
std::string escaped(const std::string& text);

/// escaped(), with μs, μr, α and the powers of an equation set as symbols.
std::string typeset(const std::string& text);

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

/// A file as a `data:` address; the type follows from the ending (.png, .jpg, .jpeg, .svg).
/// Throws std::runtime_error for a file that cannot be read or another ending.
std::string data_address(const std::filesystem::path& file);

/// Throws std::runtime_error where the file cannot be read.
std::string contents_of(const std::filesystem::path& file);

}  // namespace repose::report
