#include "tools/report/report_html.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace repose::report {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// "^0.25" to a superscript; a power ends at the first character that no number holds.
void raise_powers(std::string& text) {
  for (std::size_t at = text.find('^'); at != std::string::npos; at = text.find('^', at + 1)) {
    std::size_t end = text.find_first_not_of("0123456789.-+e", at + 1);
    if (end == std::string::npos) end = text.size();
    if (end == at + 1) continue;
    std::string power = text.substr(at + 1, end - at - 1);
    replace_all(power, "-", "−");
    text.replace(at, end - at, "<sup>" + power + "</sup>");
  }
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string typeset(const std::string& text) {
  std::string result = escaped(text);
  raise_powers(result);
  replace_all(result, "μs", "<i>μ</i><sub>s</sub>");
  replace_all(result, "μr", "<i>μ</i><sub>r</sub>");
  replace_all(result, " %", "\u00a0%");
  replace_all(result, "α", "<i>α</i>");
  replace_all(result, " e<sup>", " <i>e</i><sup>");
  replace_all(result, " e = ", " <i>e</i> = ");
  replace_all(result, "(e = ", "(<i>e</i> = ");
  replace_all(result, " = ", "\u00a0=\u00a0");  // a value stays with its name
  return result;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = (word << 8U) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? kDigits[(word >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return result;
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string data_address(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  std::string type;
  if (ending == ".png") type = "image/png";
  if (ending == ".jpg" || ending == ".jpeg") type = "image/jpeg";
  if (ending == ".svg") type = "image/svg+xml";
  if (type.empty()) throw std::runtime_error(file.string() + ": a picture must be a .png, .jpg or .svg file");
  return "data:" + type + ";base64," + base64(contents_of(file));
}

}  // namespace repose::report
