#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace repose {

/// An element of an XML file, read strictly: anything not well formed throws std::runtime_error.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  std::vector<XmlElement> children;

  /// The only child of that name.
  [[nodiscard]] const XmlElement& child(const std::string& wanted) const {
    const XmlElement* found = nullptr;
    for (const XmlElement& c : children) {
      if (c.name != wanted) continue;
      if (found) throw std::runtime_error("more than one <" + wanted + ">");
      found = &c;
    }
    if (!found) throw std::runtime_error("no <" + wanted + "> in <" + name + ">");
    return *found;
  }
};

/// Elements, attributes in double quotes, text and the five entities; no comments, no CDATA.
class XmlReader {
 public:
  explicit XmlReader(std::string text) : text_(std::move(text)) {}

  XmlElement document() {
    if (text_.compare(0, 5, "<?xml") == 0) at_ = text_.find("?>") + 2;
    skip_space();
    XmlElement root = element();
    skip_space();
    if (at_ != text_.size()) fail("text after the root element");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at character " + std::to_string(at_));
  }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void expect(const std::string& token) {
    if (text_.compare(at_, token.size(), token) != 0) fail("expected " + token);
    at_ += token.size();
  }
  void skip_space() {
    while (peek() == ' ' || peek() == '\n' || peek() == '\t' || peek() == '\r') ++at_;
  }
  std::string word() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '_' || peek() == '-') ++at_;
    if (at_ == begin) fail("expected a name");
    return text_.substr(begin, at_ - begin);
  }
  std::string characters(char end) {
    std::string out;
    while (peek() != end) {
      if (at_ >= text_.size() || peek() == '<') fail("unexpected end of text");
      if (peek() == '&') {
        out += entity();
      } else {
        out += text_[at_++];
      }
    }
    return out;
  }
  char entity() {
    for (const auto& [name, value] : std::map<std::string, char>{
             {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}) {
      if (text_.compare(at_, name.size(), name) != 0) continue;
      at_ += name.size();
      return value;
    }
    fail("unknown entity");
  }
  XmlElement element() {
    expect("<");
    XmlElement e;
    e.name = word();
    skip_space();
    while (peek() != '>' && peek() != '/') {
      const std::string key = word();
      expect("=\"");
      if (!e.attributes.emplace(key, characters('"')).second) fail("attribute twice");
      expect("\"");
      skip_space();
    }
    if (peek() == '/') {
      expect("/>");
      return e;
    }
    expect(">");
    while (true) {
      e.text += characters('<');
      if (text_.compare(at_, 2, "</") == 0) break;
      e.children.push_back(element());
    }
    expect("</" + e.name + ">");
    return e;
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace repose
