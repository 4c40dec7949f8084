// NIfTI-1 and NIfTI-2, one file, plain or gzip, of both byte orders.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/voxels.hpp>
#include <vector>

namespace heml {
namespace {

constexpr std::size_t nifti1_size = 348, nifti2_size = 540;

/// Where the two versions keep the same things, in bytes from the beginning.
struct NiftiLayout {
  std::size_t dim, datatype, pixdim, vox_offset, slope, units, qform_code, sform_code, quaternion, qoffset, srow;
};
constexpr NiftiLayout nifti1{40, 70, 76, 108, 112, 123, 252, 254, 256, 268, 280};
constexpr NiftiLayout nifti2{16, 12, 104, 168, 176, 500, 344, 348, 352, 376, 400};

class NiftiHeader {
 public:
  explicit NiftiHeader(const std::filesystem::path& path) : file_(path.string()), is_compressed_(is_gzip_file(path)) {
    ByteReader in(path, 0, is_compressed_);
    bytes_.resize(nifti1_size);
    in.read(bytes_);
    for (const bool big : {false, true}) {
      is_big_endian_ = big;
      const auto size = bits(0, 4);
      if (size == nifti1_size) {
        check_magic("n+1", 344);
        return;
      }
      if (size != nifti2_size) continue;
      bytes_.resize(nifti2_size);
      in.read(std::span(bytes_).subspan(nifti1_size));
      is_second_ = true;
      check_magic("n+2", 4);
      return;
    }
    throw InputError(file_, "byte 0", "does not begin as NIfTI files do (348 or 540)", "a .nii file, plain or gzip");
  }

  const NiftiLayout& layout() const { return is_second_ ? nifti2 : nifti1; }
  bool is_big_endian() const { return is_big_endian_; }
  bool is_compressed() const { return is_compressed_; }
  bool is_second() const { return is_second_; }

  long long integer(std::size_t at, std::size_t size) const {
    const auto value = bits(at, size);
    if (size == 2) return static_cast<std::int16_t>(value);
    if (size == 4) return static_cast<std::int32_t>(value);
    return static_cast<long long>(value);
  }
  /// Element of an array of reals, of 4 bytes in the first version and 8 in the second.
  double real(std::size_t at, std::size_t element = 0) const {
    if (is_second_) return std::bit_cast<double>(bits(at + 8 * element, 8));
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits(at + 4 * element, 4))));
  }
  long long dim(std::size_t element) const {
    return is_second_ ? integer(nifti2.dim + 8 * element, 8) : integer(nifti1.dim + 2 * element, 2);
  }
  /// Codes have 2 bytes in the first version and 4 in the second.
  long long code(std::size_t at) const { return integer(at, is_second_ ? 4 : 2); }
  int units() const {
    return static_cast<int>(is_second_ ? integer(nifti2.units, 4) : static_cast<unsigned char>(bytes_[nifti1.units]));
  }

 private:
  std::uint64_t bits(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < size; ++b)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at + b]))
               << (8 * (is_big_endian_ ? size - 1 - b : b));
    return value;
  }
  void check_magic(std::string_view magic, std::size_t at) const {
    const std::string_view found(&bytes_[at], 3);
    if (found == magic) return;
    if (found[0] == 'n' && found[1] == 'i')
      throw InputError(file_, fmt::format("byte {}", at),
                       "is a header whose voxels are in another file (.hdr and .img)", "save it as one .nii file");
    throw InputError(file_, fmt::format("byte {}", at), fmt::format("there is no '{}'", magic), "a NIfTI file");
  }

  std::string file_;
  bool is_compressed_, is_big_endian_ = false, is_second_ = false;
  std::vector<char> bytes_;
};

void set_nifti_type(long long datatype, VolumeHeader& volume) {
  using Number = VolumeHeader::Number;
  struct Type {
    long long code;
    Number number;
    std::size_t bytes;
  };
  constexpr Type types[] = {{2, Number::unsigned_integer, 1},
                            {4, Number::signed_integer, 2},
                            {8, Number::signed_integer, 4},
                            {16, Number::real, 4},
                            {64, Number::real, 8},
                            {256, Number::signed_integer, 1},
                            {512, Number::unsigned_integer, 2},
                            {768, Number::unsigned_integer, 4},
                            {1024, Number::signed_integer, 8},
                            {1280, Number::unsigned_integer, 8}};
  for (const Type& type : types)
    if (type.code == datatype) {
      volume.number = type.number;
      volume.bytes = type.bytes;
      return;
    }
  throw InputError(volume.map.source, "datatype", fmt::format("voxels of type {}", datatype),
                   "integers or reals of 8 to 64 bits");
}

/// Metres of the header's unit of length; millimetres where it names none.
double metres_of_nifti(const NiftiHeader& header, const std::string& file) {
  switch (header.units() & 7) {
    case 0:
    case 2:
      return 1e-3;
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      throw InputError(file, "xyzt_units", fmt::format("unit {} of length", header.units() & 7),
                       "1 (metres), 2 (millimetres) or 3 (micrometres)");
  }
}

Mat3 rotation_of_quaternion(double b, double c, double d) {
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  return Eigen::Quaterniond(a, b, c, d).normalized().toRotationMatrix();
}

/// The affine from voxel numbers to right, anterior, superior: sform, else qform, else the spacing alone.
void set_nifti_axes(const NiftiHeader& header, LabelMap& map) {
  const NiftiLayout& at = header.layout();
  const double unit = metres_of_nifti(header, map.source);
  const Vec3 spacing(header.real(at.pixdim, 1), header.real(at.pixdim, 2), header.real(at.pixdim, 3));
  if (header.code(at.sform_code) > 0) {
    for (std::size_t row = 0; row < 3; ++row) {
      const auto r = static_cast<int>(row);
      for (std::size_t d = 0; d < 3; ++d) map.axes(r, static_cast<int>(d)) = header.real(at.srow, 4 * row + d);
      map.origin[r] = header.real(at.srow, 4 * row + 3);
    }
  } else if (header.code(at.qform_code) > 0) {
    map.axes = rotation_of_quaternion(header.real(at.quaternion), header.real(at.quaternion, 1),
                                      header.real(at.quaternion, 2)) *
               spacing.asDiagonal();
    if (header.real(at.pixdim) < 0) map.axes.col(2) *= -1;
    for (int d = 0; d < 3; ++d) map.origin[d] = header.real(at.qoffset, static_cast<std::size_t>(d));
  } else {
    map.axes = spacing.cwiseAbs().asDiagonal();
  }
  map.axes *= unit;
  map.origin *= unit;
}

void set_nifti_size(const NiftiHeader& header, LabelMap& map) {
  const long long dimensions = header.dim(0);
  if (dimensions < 1 || dimensions > 7)
    throw InputError(map.source, "dim[0]", fmt::format("{} dimensions", dimensions), "3");
  std::array<long long, 3> size{1, 1, 1};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d)
    if (d < 3)
      size[d] = header.dim(d + 1);
    else if (header.dim(d + 1) != 1)
      throw InputError(map.source, fmt::format("dim[{}]", d + 1),
                       fmt::format("a series of {} volumes", header.dim(d + 1)), "one label map a file");
  set_size(map, size, "dim");
}

}  // namespace

VolumeHeader read_nifti_header(const std::filesystem::path& path) {
  const NiftiHeader header(path);
  const NiftiLayout& at = header.layout();
  VolumeHeader volume;
  volume.map.source = path.string();
  set_nifti_size(header, volume.map);
  set_nifti_type(header.integer(at.datatype, 2), volume);
  set_nifti_axes(header, volume.map);
  volume.is_big_endian = header.is_big_endian();
  const double slope = header.real(at.slope), intercept = header.real(at.slope, 1);
  if (std::isfinite(slope) && std::isfinite(intercept) && slope != 0) {
    volume.slope = slope;
    volume.intercept = intercept;
  }
  const double offset =
      header.is_second() ? static_cast<double>(header.integer(at.vox_offset, 8)) : header.real(at.vox_offset);
  const std::size_t size = header.is_second() ? nifti2_size : nifti1_size;
  if (!(offset >= static_cast<double>(size)) || offset > 1e9 || offset != std::floor(offset))
    throw InputError(path.string(), "vox_offset", fmt::format("voxels begin at byte {:.6g}", offset),
                     fmt::format("{} or more, after the header", size));
  volume.data_file = path;
  volume.data_offset = static_cast<std::uint64_t>(offset);
  volume.is_compressed = volume.inflated_offset = header.is_compressed();
  return volume;
}

}  // namespace heml
