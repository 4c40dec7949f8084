#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/panel/mesh_openings.hpp>
#include <cstdlib>

namespace heml::panel {
namespace {

std::string name_of_unit(const LengthUnit& unit) {
  return unit.name.empty() ? fmt::format("scaled by {:.3g}", unit.scale) : unit.name;
}

}  // namespace

std::string change_text(const BareMeshOptions& before, const BareMeshOptions& after) {
  std::vector<std::string> changes;
  const auto compare = [&](const char* what, const auto& old, const auto& now, auto name) {
    if (old != now) changes.push_back(fmt::format("{}: {}", what, now ? name(*now) : std::string("as guessed")));
  };
  compare("unit", before.unit, after.unit, name_of_unit);
  compare("up", before.up, after.up, [](UpAxis axis) { return std::string(info_of(axis).name); });
  compare("supports", before.supports, after.supports, [](SupportKind kind) { return std::string(name_of(kind)); });
  compare("tissue", before.tissue, after.tissue, [](const std::string& name) { return name; });
  compare("tetrahedra", before.tets, after.tets, [](int tets) { return fmt::format("{}", tets); });
  return changes.empty() ? "as guessed" : fmt::format("{}", fmt::join(changes, ", "));
}

void MeshOpenings::adopt(const std::string& file, const BareMeshOptions& options, std::optional<int> own_tets) {
  if (file != file_ || own_tets) own_tets_ = own_tets;
  if (file != file_) {
    file_ = file;
    all_ = {options};
    now_ = 0;
    return;
  }
  int nearest = -1;
  for (int k = 0; k < std::ssize(all_); ++k)
    if (all_[k] == options && (nearest < 0 || std::abs(k - now_) < std::abs(nearest - now_))) nearest = k;
  if (nearest < 0) {
    all_.resize(static_cast<std::size_t>(now_) + 1);
    all_.push_back(options);
    nearest = now_ + 1;
  }
  now_ = nearest;
}

const BareMeshOptions* MeshOpenings::at(int by) const {
  const int k = now_ + by;
  return k < 0 || k >= std::ssize(all_) ? nullptr : &all_[k];
}

std::string MeshOpenings::text(int by) const {
  const BareMeshOptions *opening = at(by), *before = at(by - 1);
  return opening ? change_text(before ? *before : BareMeshOptions(), *opening) : "";
}

}  // namespace heml::panel
