#pragma once
// Builds the text of a mesh file.
#include <fmt/format.h>

#include <filesystem>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <iterator>
#include <utility>

namespace heml {

/// Numbers have 17 significant digits, so reading gives the same double.
class MeshText {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void add_point(const Vec3& x) { add("{:.17g} {:.17g} {:.17g}", x[0], x[1], x[2]); }
  void add_nodes(const Tet& tet, int first) {
    add("{} {} {} {}", tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first);
  }
  /// Adds the values of one element or node and a line end.
  template <class Field>
  void add_values(const Field& field, std::size_t which) {
    for (std::size_t i = 0; i < field.components; ++i)
      add("{:.17g}{}", field.values[field.components * which + i], i + 1 < field.components ? ' ' : '\n');
  }

  /// Throws InputError if the file cannot be written.
  void save(const std::filesystem::path& path) const { write_file(path, {text_.data(), text_.size()}); }

 private:
  fmt::memory_buffer text_;
};

}  // namespace heml
