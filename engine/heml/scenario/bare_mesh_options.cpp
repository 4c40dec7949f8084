#include <heml/scenario/bare_mesh_options.hpp>

namespace heml {

const UpAxisInfo& info_of(UpAxis axis) {
  static const UpAxisInfo y{"y", Vec3::UnitZ(), 0}, minus_y{"-y", Vec3::UnitZ(), 180};
  static const UpAxisInfo z{"z", Vec3::UnitX(), -90}, minus_z{"-z", Vec3::UnitX(), 90};
  static const UpAxisInfo x{"x", Vec3::UnitZ(), 90}, minus_x{"-x", Vec3::UnitZ(), -90};
  switch (axis) {
    case UpAxis::y:
      return y;
    case UpAxis::minus_y:
      return minus_y;
    case UpAxis::z:
      return z;
    case UpAxis::minus_z:
      return minus_z;
    case UpAxis::x:
      return x;
    case UpAxis::minus_x:
      return minus_x;
  }
  return y;
}

const char* name_of(SupportKind kind) {
  switch (kind) {
    case SupportKind::underside:
      return "underside";
    case SupportKind::top:
      return "top";
    case SupportKind::table:
      return "table";
  }
  return "";
}

}  // namespace heml
