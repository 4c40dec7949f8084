#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <heml/base/byte_order_mark.hpp>
#include <heml/base/error.hpp>
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/xml.hpp>
#include <limits>

namespace heml {
namespace {

constexpr std::string_view xml_blanks = " \t\r\n", name_ends = " \t\r\n/>=\"'<";
constexpr std::size_t max_xml_depth = 64;

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(xml_blanks), text.size());
  return text.substr(begin, text.find_last_not_of(xml_blanks) + 1 - begin);
}

/// As UTF-8 (RFC 3629); empty for what is no character.
std::string utf8(unsigned long code) {
  std::string text;
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (code >> shift & 0x3f)); };
  if (code == 0 || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return "";
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | code >> 6);
    tail(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | code >> 12);
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0 | code >> 18);
    tail(12), tail(6), tail(0);
  }
  return text;
}

/// What an entity between & and ; stands for; empty: it is not known.
std::string entity_text(std::string_view entity) {
  constexpr std::pair<std::string_view, char> known[] = {
      {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}, {"amp", '&'}};
  for (const auto& [name, character] : known)
    if (entity == name) return std::string(1, character);
  if (!entity.starts_with('#')) return "";
  const bool hexadecimal = entity.starts_with("#x");
  const std::string_view digits = entity.substr(hexadecimal ? 2 : 1);
  unsigned long code = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
  return error == std::errc() && end == digits.data() + digits.size() ? utf8(code) : "";
}

std::string unescaped_xml(std::string_view value) {
  std::string text;
  while (!value.empty()) {
    const std::size_t entity = std::min(value.find('&'), value.size());
    text += value.substr(0, entity);
    value.remove_prefix(entity);
    if (value.empty()) break;
    const std::size_t end = value.find(';');
    const std::string meant = end == value.npos ? "" : entity_text(value.substr(1, end - 1));
    text += meant.empty() ? "&" : meant;
    value.remove_prefix(meant.empty() ? 1 : end + 1);
  }
  return text;
}

}  // namespace

/// Reads tags in their order; `open_` holds the elements that have not ended.
class XmlDocument::Parser {
 public:
  explicit Parser(XmlDocument& document) : document_(document), text_(document.text_) {}

  void parse() {
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff")) fail(0, "is in UTF-16", "save it in UTF-8");
    at_ = byte_order_mark_size(text_);
    while (at_ < text_.size()) {
      const std::size_t tag = std::min(text_.find('<', at_), text_.size());
      characters(text_.substr(at_, tag - at_));
      at_ = tag;
      if (at_ < text_.size()) markup();
    }
    if (!open_.empty()) fail(text_.size(), "ends within " + tag_text(open_.back()), "the file is cut off");
    if (document_.nodes_.empty()) fail(0, "holds no XML element");
  }

 private:
  struct Open {
    int node, last_child;
    std::size_t pieces;  ///< of text, with CDATA and between comments
    std::string joined;
  };

  [[noreturn]] void fail(std::size_t offset, const std::string& problem, const std::string& remedy = "") const {
    document_.fail(std::min(offset, text_.size()), problem, remedy);
  }
  Node& node(const Open& open) const { return document_.nodes_[static_cast<std::size_t>(open.node)]; }
  std::string tag_text(const Open& open) const { return "<" + std::string(node(open).name) + ">"; }

  /// Moves behind `end`.
  std::string_view up_to(std::string_view end, const char* what) {
    const std::size_t found = text_.find(end, at_);
    if (found == text_.npos) fail(at_, std::string(what) + " does not end", "the file is cut off or damaged");
    const std::string_view part = text_.substr(at_, found - at_);
    at_ = found + end.size();
    return part;
  }

  void markup() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("<!--")) {
      up_to("-->", "a comment");
    } else if (rest.starts_with("<?")) {
      up_to("?>", "an instruction <?");
    } else if (rest.starts_with("<![CDATA[")) {
      at_ += 9;
      characters(up_to("]]>", "a CDATA section"));
    } else if (rest.starts_with("<!")) {
      fail(at_, "a DOCTYPE or an entity of its own, which is not read", "take it out of the file");
    } else if (rest.starts_with("</")) {
      end_tag();
    } else {
      start_tag();
    }
  }

  void characters(std::string_view piece) {
    if (without_blanks(piece).empty()) return;
    if (open_.empty()) {
      const bool before = document_.nodes_.empty();
      fail(at_, before ? "is no XML: it begins with " + in_quotes(without_blanks(piece))
                       : "text behind the last element: " + in_quotes(without_blanks(piece)));
    }
    Open& open = open_.back();
    if (open.pieces++ == 0) {
      node(open).text = piece;
      return;
    }
    if (open.pieces == 2) open.joined = node(open).text;
    open.joined += piece;
  }

  void start_tag() {
    const std::size_t begin = at_ + 1, end = tag_end(begin);
    const std::string_view inner = text_.substr(begin, end - begin);
    const bool is_empty = inner.ends_with('/');
    const std::size_t name_end = std::min(inner.find_first_of(name_ends), inner.size());
    if (name_end == 0) fail(at_, "a tag without a name");
    if (open_.empty() && !document_.nodes_.empty()) fail(at_, "a second element beside the first");
    if (open_.size() >= max_xml_depth) fail(at_, fmt::format("elements nested more than {} deep", max_xml_depth));
    if (document_.nodes_.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
      fail(at_, "more elements than can be counted");
    const int index = static_cast<int>(document_.nodes_.size());
    document_.nodes_.push_back(
        {inner.substr(0, name_end), inner.substr(name_end, inner.size() - name_end - (is_empty ? 1 : 0)), {}, at_});
    if (!open_.empty()) {
      Open& parent = open_.back();
      (parent.last_child < 0 ? node(parent).first_child
                             : document_.nodes_[static_cast<std::size_t>(parent.last_child)].next) = index;
      parent.last_child = index;
    }
    at_ = end + 1;
    if (!is_empty) open_.push_back({index, -1, 0, {}});
  }

  /// The > that ends a tag, outside of quotes.
  std::size_t tag_end(std::size_t from) const {
    for (std::size_t i = from; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '>') return i;
      if (c == '<') fail(at_, "a tag does not end before the next begins", "the file is damaged");
      if (c != '"' && c != '\'') continue;
      i = text_.find(c, i + 1);
      if (i == text_.npos) break;
    }
    fail(at_, "a tag does not end", "the file is cut off or damaged");
  }

  void end_tag() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string_view name = without_blanks(up_to(">", "a tag"));
    if (open_.empty()) fail(begin, "</" + std::string(name.substr(0, 40)) + "> ends what did not begin");
    Open& open = open_.back();
    if (node(open).name != name)
      fail(begin, fmt::format("{} where </{}> should be, which began in line {}", in_quotes("</" + std::string(name)),
                              node(open).name, document_.line(node(open).offset)));
    if (open.pieces > 1) node(open).text = document_.joined_.emplace_back(std::move(open.joined));
    node(open).text = without_blanks(node(open).text);
    if (node(open).first_child >= 0) node(open).text = {};
    open_.pop_back();
  }

  XmlDocument& document_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Open> open_;
};

XmlDocument::XmlDocument(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {
  Parser(*this).parse();
}

std::size_t XmlDocument::line(std::size_t offset) const {
  return 1 +
         static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

void XmlDocument::fail(std::size_t offset, const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, fmt::format("line {}", line(offset)), problem, remedy);
}

std::string_view XmlElement::name() const { return document_->nodes_[static_cast<std::size_t>(index_)].name; }
std::string_view XmlElement::text() const { return document_->nodes_[static_cast<std::size_t>(index_)].text; }
const std::string& XmlElement::file() const { return document_->file_; }
std::string_view XmlElement::document() const { return document_->text_; }
std::size_t XmlElement::line() const {
  return document_->line(document_->nodes_[static_cast<std::size_t>(index_)].offset);
}
void XmlElement::fail(const std::string& problem, const std::string& remedy) const {
  document_->fail(document_->nodes_[static_cast<std::size_t>(index_)].offset, problem, remedy);
}

std::optional<std::string> XmlElement::attribute(std::string_view key) const {
  std::string_view rest = document_->nodes_[static_cast<std::size_t>(index_)].attributes;
  while (true) {
    rest = without_blanks(rest);
    if (rest.empty()) return std::nullopt;
    const std::size_t equals = rest.find('=');
    if (equals == rest.npos) fail("an attribute without a value: " + in_quotes(rest));
    const std::string_view name = without_blanks(rest.substr(0, equals));
    rest = without_blanks(rest.substr(equals + 1));
    if (rest.empty() || (rest[0] != '"' && rest[0] != '\''))
      fail("the value of the attribute " + in_quotes(name) + " is not in quotes");
    const std::size_t close = rest.find(rest[0], 1);
    if (close == rest.npos) fail("the value of the attribute " + in_quotes(name) + " does not end");
    if (name == key) return unescaped_xml(rest.substr(1, close - 1));
    rest.remove_prefix(close + 1);
  }
}

XmlChildren XmlElement::children() const { return XmlChildren(*this); }

std::optional<XmlElement> XmlElement::child(std::string_view name) const {
  for (const XmlElement element : children())
    if (element.name() == name) return element;
  return std::nullopt;
}

XmlChildren::Iterator XmlChildren::begin() const {
  const XmlDocument& document = *parent_.document_;
  return Iterator({document, document.nodes_[static_cast<std::size_t>(parent_.index_)].first_child});
}
XmlChildren::Iterator XmlChildren::end() const { return Iterator({*parent_.document_, -1}); }
XmlChildren::Iterator& XmlChildren::Iterator::operator++() {
  at_.index_ = at_.document_->nodes_[static_cast<std::size_t>(at_.index_)].next;
  return *this;
}

}  // namespace heml
