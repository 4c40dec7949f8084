#include <doctest/doctest.h>

#include <heml/base/error.hpp>

#include "engine/mesh/labels/volumes.hpp"

namespace heml::label_map_test {
namespace {

using test::deflated;
using test::put;
using test::VolumeFile;

// 3 x 2 x 2 voxels, of labels 0, 2 and 5.
const std::vector<int> labels{0, 2, 0, 5, 0, 0, 0, 0, 2, 2, 0, 5};
const std::vector<std::uint8_t> indices{0, 1, 0, 2, 0, 0, 0, 0, 1, 1, 0, 2};

template <class Number>
std::string raw(bool big = false, double slope = 1, double intercept = 0) {
  std::string bytes(labels.size() * sizeof(Number), '\0');
  for (std::size_t v = 0; v < labels.size(); ++v)
    put(bytes, v * sizeof(Number), static_cast<Number>((labels[v] - intercept) / slope), big);
  return bytes;
}

/// NIfTI-1 with an sform: i to the right by 2 mm, j back by 3, k up by 4.
std::string nifti(bool big, std::int16_t type, const std::string& voxels) {
  std::string bytes(352, '\0');
  put<std::int32_t>(bytes, 0, 348, big);
  const std::array<std::int16_t, 8> dim{3, 3, 2, 2, 1, 1, 1, 1};
  for (std::size_t d = 0; d < 8; ++d) put(bytes, 40 + 2 * d, dim[d], big);
  put(bytes, 70, type, big);
  const std::array<float, 4> pixdim{1, 2, 3, 4};
  for (std::size_t d = 0; d < 4; ++d) put(bytes, 76 + 4 * d, pixdim[d], big);
  put(bytes, 108, 352.0f, big);
  bytes[123] = 2;  // mm
  put<std::int16_t>(bytes, 254, 1, big);
  const std::array<float, 12> srow{2, 0, 0, 10, 0, -3, 0, 20, 0, 0, 4, 30};
  for (std::size_t k = 0; k < 12; ++k) put(bytes, 280 + 4 * k, srow[k], big);
  bytes.replace(344, 3, "n+1");
  return bytes + voxels;
}

std::string nifti2(const std::string& voxels) {
  std::string bytes(544, '\0');
  put<std::int32_t>(bytes, 0, 540);
  bytes.replace(4, 3, "n+2");
  put<std::int16_t>(bytes, 12, 512);
  const std::array<std::int64_t, 8> dim{3, 3, 2, 2, 1, 1, 1, 1};
  for (std::size_t d = 0; d < 8; ++d) put(bytes, 16 + 8 * d, dim[d]);
  const std::array<double, 4> pixdim{-1, 2, 3, 4};
  for (std::size_t d = 0; d < 4; ++d) put(bytes, 104 + 8 * d, pixdim[d]);
  put<std::int64_t>(bytes, 168, 544);
  put<std::int32_t>(bytes, 344, 1);  // qform: half a turn about x, and qfac −1
  put(bytes, 352, 1.0);
  put(bytes, 376, 10.0);
  put<std::int32_t>(bytes, 500, 1);  // m
  return bytes + voxels;
}

void check_voxels(const LabelMap& map) {
  CHECK(map.size == std::array{3, 2, 2});
  CHECK(map.values == std::vector{0, 2, 5});
  CHECK(map.voxels == indices);
}

void check_axes(const LabelMap& map, const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& origin) {
  CHECK((map.axes.col(0) - i).norm() < 1e-9);
  CHECK((map.axes.col(1) - j).norm() < 1e-9);
  CHECK((map.axes.col(2) - k).norm() < 1e-9);
  CHECK((map.origin - origin).norm() < 1e-9);
}

void check_refused(const std::string& name, const std::string& bytes, const char* reason) {
  const VolumeFile file(name, bytes);
  try {
    read_label_map(file.path());
    FAIL("was read");
  } catch (const InputError& error) {
    const std::string text = error.what();
    CHECK_MESSAGE(text.find(reason) != std::string::npos, text);
    CHECK(text.find(file.path().string()) != std::string::npos);
  }
}

std::string nrrd(const std::string& encoding, const std::string& more = "") {
  return "NRRD0004\n# made by a test\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 2 2\n"
         "space directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (-10,-20,30)\nendian: little\nencoding: " +
         encoding + "\n" + more;
}

std::string metaimage(const std::string& data, const std::string& more = "") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" + more +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -10 -20 30\nElementSpacing = 2 3 4\nDimSize = 3 2 2\n"
         "ElementType = MET_USHORT\nElementDataFile = " +
         data + "\n";
}

}  // namespace

TEST_CASE("NIfTI of both byte orders and all numbers, plain and gzip, by its sform") {
  for (const bool big : {false, true})
    for (const bool packed : {false, true}) {
      const auto check = [&](std::int16_t type, const std::string& voxels) {
        const std::string bytes = nifti(big, type, voxels);
        const VolumeFile file(packed ? "a.nii.gz" : "a.nii", packed ? deflated(bytes) : bytes);
        const LabelMap map = read_label_map(file.path());
        check_voxels(map);
        check_axes(map, {2e-3, 0, 0}, {0, -3e-3, 0}, {0, 0, 4e-3}, {0.01, 0.02, 0.03});
      };
      check(2, raw<std::uint8_t>(big));
      check(256, raw<std::int8_t>(big));
      check(4, raw<std::int16_t>(big));
      check(512, raw<std::uint16_t>(big));
      check(8, raw<std::int32_t>(big));
      check(768, raw<std::uint32_t>(big));
      check(1024, raw<std::int64_t>(big));
      check(1280, raw<std::uint64_t>(big));
      check(16, raw<float>(big));
      check(64, raw<double>(big));
    }
}

TEST_CASE("NIfTI-2, its quaternion and its unit") {
  const VolumeFile file("b.nii", nifti2(raw<std::uint16_t>()));
  const LabelMap map = read_label_map(file.path());
  check_voxels(map);
  check_axes(map, {2, 0, 0}, {0, -3, 0}, {0, 0, 4}, {10, 0, 0});
}

TEST_CASE("slope and intercept of NIfTI, and spacing alone where it has no directions") {
  std::string bytes = nifti(false, 16, raw<float>(false, 0.5, 2));
  put(bytes, 112, 0.5f);
  put(bytes, 116, 2.0f);
  put<std::int16_t>(bytes, 254, 0);
  const VolumeFile file("c.nii", bytes);
  const LabelMap map = read_label_map(file.path());
  check_voxels(map);
  check_axes(map, {2e-3, 0, 0}, {0, 3e-3, 0}, {0, 0, 4e-3}, Vec3::Zero());
}

TEST_CASE("labels that are not named are outside") {
  const VolumeFile file("d.nii", nifti(false, 2, raw<std::uint8_t>()));
  const LabelMap map = read_label_map(file.path(), {5});
  CHECK(map.values == std::vector{0, 5});
  CHECK(map.voxels == std::vector<std::uint8_t>{0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1});
  CHECK_THROWS_WITH_AS(read_label_map(file.path(), {3}), doctest::Contains("label 3: no voxel has it"), InputError);
}

TEST_CASE("NRRD raw, gzip and ascii, turned from left and posterior, with names of segments") {
  const std::string names =
      "Segment0_Name:=liver\nSegment0_LabelValue:=2\nSegment1_Name:=portal vein\n"
      "Segment1_LabelValue:=5\n";
  std::string text;
  for (const int label : labels) text += std::to_string(label) + " ";
  for (const std::string& bytes :
       {nrrd("raw", names + "\n") + raw<std::int16_t>(), nrrd("gzip", names + "\n") + deflated(raw<std::int16_t>()),
        nrrd("ascii", names + "\n") + text}) {
    const VolumeFile file("e.nrrd", bytes);
    const LabelMap map = read_label_map(file.path());
    check_voxels(map);
    check_axes(map, {-2e-3, 0, 0}, {0, -3e-3, 0}, {0, 0, 4e-3}, {0.01, 0.02, 0.03});
    CHECK(map.names == std::map<int, std::string>{{2, "liver"}, {5, "portal vein"}});
    CHECK(label_names_in_header(file.path()) == map.names);
  }
}

TEST_CASE("NRRD and MetaImage with voxels in another file") {
  const VolumeFile data("f.raw", "1234" + raw<std::int16_t>());
  const VolumeFile header("f.nhdr", nrrd("raw", "byte skip: 4\ndata file: f.raw\n"));
  check_voxels(read_label_map(header.path()));
  const VolumeFile plain("g.raw", raw<std::uint16_t>());
  const VolumeFile meta("g.mhd", metaimage("g.raw"));
  check_voxels(read_label_map(meta.path()));
}

TEST_CASE("MetaImage, plain and compressed") {
  for (const std::string& bytes : {metaimage("LOCAL") + raw<std::uint16_t>(),
                                   metaimage("LOCAL", "CompressedData = True\n") + deflated(raw<std::uint16_t>(), 0)}) {
    const VolumeFile file("h.mha", bytes);
    const LabelMap map = read_label_map(file.path());
    check_voxels(map);
    check_axes(map, {-2e-3, 0, 0}, {0, -3e-3, 0}, {0, 0, 4e-3}, {0.01, 0.02, 0.03});
  }
}

TEST_CASE("damaged and unsuitable NIfTI files are refused with the reason") {
  const std::string good = nifti(false, 2, raw<std::uint8_t>());
  check_refused("i.nii", good.substr(0, 200), "the file ends here");
  check_refused("i.nii", good.substr(0, good.size() - 3), "announces 12 bytes of voxels, and 9 are there");
  check_refused("i.nii.gz", deflated(good).substr(0, 60), "the file ends here");
  std::string packed = deflated(good);
  packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x55);
  CHECK_THROWS_AS(read_label_map(VolumeFile("i.nii.gz", packed).path()), InputError);
  std::string bytes = good;
  for (std::size_t d = 1; d < 4; ++d) put<std::int16_t>(bytes, 40 + 2 * d, 1000);
  check_refused("i.nii", bytes, "1000 x 1000 x 1000 voxels");
  for (std::size_t d = 1; d < 4; ++d) put<std::int16_t>(bytes, 40 + 2 * d, 700);
  check_refused("i.nii", bytes, "announces 343000000 bytes");
  check_refused("i.nii.gz", deflated(bytes), "announces");
  put<std::int16_t>(bytes, 42, -3);
  check_refused("i.nii", bytes, "-3 voxels along axis 0");
  bytes = good;
  put<std::int16_t>(bytes, 70, 128);
  check_refused("i.nii", bytes, "voxels of type 128");
  bytes = good;
  put<std::int16_t>(bytes, 40, 4);
  put<std::int16_t>(bytes, 48, 7);
  check_refused("i.nii", bytes, "a series of 7 volumes");
  bytes = good;
  put(bytes, 280, 0.0f);
  check_refused("i.nii", bytes, "voxels step by");
  check_refused("i.nii", std::string(400, 'x'), "does not begin as NIfTI files do");
  check_refused("i.nii", nifti(false, 2, std::string(12, '\0')), "holds no label");
  std::string real = nifti(false, 16, raw<float>());
  put(real, 352 + 4 * 4, 0.5f);
  check_refused("i.nii", real, "voxel (1, 1, 0)");
}

TEST_CASE("a scan instead of its segmentation is refused") {
  std::string bytes = nifti(false, 4, std::string(2000, '\0'));
  put<std::int16_t>(bytes, 42, 1000);
  put<std::int16_t>(bytes, 44, 1);
  put<std::int16_t>(bytes, 46, 1);
  for (std::size_t v = 0; v < 1000; ++v) put(bytes, 352 + 2 * v, static_cast<std::int16_t>(v - 500));
  check_refused("j.nii", bytes, "not the scan itself");
}

TEST_CASE("damaged and unsuitable text headers are refused with the reason") {
  check_refused("k.nrrd", nrrd("bzip2") + "\n", "'bzip2'");
  check_refused("k.nrrd", nrrd("raw") + "\n" + raw<std::int16_t>().substr(4), "announces 24 bytes");
  check_refused("k.nrrd", nrrd("ascii") + "\n1 2 3", "announces");
  check_refused("k.nrrd", nrrd("ascii") + "\n1 2 3 4 x 6 7 8 9 10 11 12 13 14", "'x' is no number");
  check_refused("k.nrrd", "NRRD0004\ntype: short\n\n", "its header lacks it");
  check_refused("k.nrrd", nrrd("raw", "sizes: 3 2 1e99\n\n"), "voxels");
  check_refused("k.nrrd", nrrd("raw", "data file: nowhere.raw\n\n"), "which is not there");
  check_refused("k.mha", "NDims = 3\n", "ElementDataFile");
  check_refused("k.mha", metaimage("LOCAL") + "abc", "announces 24 bytes");
  check_refused("k.mhd", metaimage("LIST"), "several files");
}

TEST_CASE("kinds of files by their names") {
  for (const char* name : {"a.nii", "a.nii.gz", "A.NII.GZ", "a.nrrd", "a.nhdr", "a.mha", "a.mhd"})
    CHECK(is_label_map_file(name));
  for (const char* name : {"a.gz", "a.vtu", "nii", "a.nii.txt"}) CHECK_FALSE(is_label_map_file(name));
}

}  // namespace heml::label_map_test
