#pragma once
// A small reader of XML 1.0 for files of data: elements, attributes, text, comments, CDATA, and the five named entities
// and numbered characters. A DOCTYPE is refused, so that no text expands or names another file; no encoding is
// converted, so what is not ASCII stays as its bytes. Time and memory are linear in the text.
//
//   <a k="v">                 XmlElement a: attribute("k") = "v"
//     <b>1, 2</b>               ├─ child b: text() = "1, 2"
//     <c/>                      └─ child c: text() = ""
//   </a>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

class XmlDocument;
class XmlChildren;

/// An element of an XmlDocument, which must outlive it. Cheap to copy.
class XmlElement {
 public:
  std::string_view name() const;
  /// What a leaf holds, without blanks around it and without comments; of an element with children empty.
  std::string_view text() const;
  std::optional<std::string> attribute(std::string_view key) const;
  /// The attribute; empty where there is none.
  std::string attribute_or_empty(std::string_view key) const { return attribute(key).value_or(""); }
  XmlChildren children() const;
  /// The first child of that name.
  std::optional<XmlElement> child(std::string_view name) const;
  std::size_t line() const;           ///< of the file, from 1; linear in the text before
  const std::string& file() const;    ///< for messages
  std::string_view document() const;  ///< the whole text
  /// Throws InputError with file and line.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "") const;
  bool operator==(const XmlElement&) const = default;

 private:
  friend class XmlDocument;
  friend class XmlChildren;
  XmlElement(const XmlDocument& document, int index) : document_(&document), index_(index) {}
  const XmlDocument* document_;
  int index_;
};

/// The children of an element in their order.
class XmlChildren {
 public:
  class Iterator {
   public:
    XmlElement operator*() const { return at_; }
    Iterator& operator++();
    bool operator!=(const Iterator& other) const { return !(at_ == other.at_); }

   private:
    friend class XmlChildren;
    explicit Iterator(XmlElement at) : at_(at) {}
    XmlElement at_;
  };
  explicit XmlChildren(XmlElement parent) : parent_(parent) {}
  Iterator begin() const;
  Iterator end() const;

 private:
  XmlElement parent_;
};

class XmlDocument {
 public:
  /// file: for messages. The text must outlive this. Throws InputError, with the line, for text that is no XML, is cut
  /// off, has a DOCTYPE or is in UTF-16, and for elements nested more than 64 deep.
  XmlDocument(std::string file, std::string_view text);
  XmlDocument(const XmlDocument&) = delete;
  XmlDocument& operator=(const XmlDocument&) = delete;

  XmlElement root() const { return {*this, 0}; }

 private:
  friend class XmlElement;
  friend class XmlChildren;
  struct Node {
    std::string_view name, attributes, text;
    std::size_t offset;  ///< of the tag
    int first_child = -1, next = -1;
  };
  class Parser;

  [[noreturn]] void fail(std::size_t offset, const std::string& problem, const std::string& remedy = "") const;
  std::size_t line(std::size_t offset) const;

  std::string file_;
  std::string_view text_;
  std::vector<Node> nodes_;
  std::deque<std::string> joined_;  ///< texts that comments or CDATA interrupt
};

}  // namespace heml
