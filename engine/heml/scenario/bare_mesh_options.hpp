#pragma once
// What of a bare mesh can be given instead of guessed (bare_mesh.hpp).
#include <array>
#include <heml/math/types.hpp>
#include <optional>
#include <string>

namespace heml {

/// A unit of length and its factor to metres.
struct LengthUnit {
  std::string name;  ///< metres, centimetres, ...; empty: none fits, the body is scaled to a length
  double scale;
  bool operator==(const LengthUnit&) const = default;
};

/// The axis of the file that points up.
enum class UpAxis { y, minus_y, z, minus_z, x, minus_x };
inline constexpr std::array up_axes{UpAxis::y, UpAxis::minus_y, UpAxis::z, UpAxis::minus_z, UpAxis::x, UpAxis::minus_x};

/// The rotation that turns an axis of the file to y, which points up in scenes.
struct UpAxisInfo {
  const char* name;  ///< "z", "-z"
  Vec3 about;
  double degrees;
};
const UpAxisInfo& info_of(UpAxis axis);

/// What carries the body: its lowest or highest part, which is held, or a table on which it lies loose.
enum class SupportKind { underside, top, table };
inline constexpr std::array support_kinds{SupportKind::underside, SupportKind::top, SupportKind::table};
const char* name_of(SupportKind kind);

/// What is not given is guessed.
struct BareMeshOptions {
  std::optional<LengthUnit> unit;
  std::optional<UpAxis> up;
  std::optional<SupportKind> supports;
  std::optional<std::string> tissue = {};  ///< name of a preset (presets.hpp)
  std::optional<int> tets = {};            ///< wanted number of tetrahedra, whose shapes are improved; from 1
  bool operator==(const BareMeshOptions&) const = default;
};

}  // namespace heml
