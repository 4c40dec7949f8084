#pragma once
// The choices with which a bare mesh was opened one after another: undo and redo go through them where no action on
// the body is left.
//
//     as guessed ── unit: millimetres ── up: z ── tissue: liver_human
//                                         ▲ now
#include <heml/scenario/bare_mesh_options.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

/// "unit: millimetres, up: as guessed": what another opening chose differently.
std::string change_text(const BareMeshOptions& before, const BareMeshOptions& after);

class MeshOpenings {
 public:
  /// A mesh was opened. Choices that this file was opened with before become the present ones; others come after
  /// those and take the place of what was undone. Another file begins anew. own_tets: of the file, or of the surface or
  /// scan filled as guessed; none: not known from this opening.
  void adopt(const std::string& file, const BareMeshOptions& options, std::optional<int> own_tets = {});
  void clear() { *this = {}; }

  /// The choices so many openings earlier (negative) or later; null: there are none.
  const BareMeshOptions* at(int by) const;
  /// What an opening changed, seen from the one before; as at(), and for the first one "as guessed".
  std::string text(int by) const;
  /// Number of tetrahedra without a choice of it, as the last opening of the file that told it; none: none did.
  std::optional<int> own_tets() const { return own_tets_; }

 private:
  std::string file_;
  std::vector<BareMeshOptions> all_;
  int now_ = 0;
  std::optional<int> own_tets_;
};

}  // namespace heml::panel
