// Binary .vtu files: base64 or raw, in their place or appended, plain or compressed.
#include <doctest/doctest.h>

#include <heml/mesh/quality.hpp>
#include <heml/mesh/readers.hpp>
#include <messages.hpp>

#include "engine/mesh/binary_samples.hpp"
#include "engine/mesh/files.hpp"

namespace heml::vtk_xml_data_test {

namespace {

using samples::binary_vtu;
using samples::VtuForm;

std::string refusal_of(const std::string& text) {
  return refusal([&] { read_vtu("a.vtu", text); });
}

}  // namespace

TEST_CASE("reads each form of binary VTK XML") {
  for (int bits = 0; bits < 32; ++bits) {
    const VtuForm form{(bits & 1) != 0, (bits & 3) == 3, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
    CAPTURE(bits);
    const TetMesh mesh = read_vtu("a.vtu", binary_vtu(form)).mesh;
    CHECK(mesh.nodes == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}});
    CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
    CHECK(mesh.regions == std::vector<int>{7, -3});
    REQUIRE(mesh.fields.size() == 1);
    CHECK(mesh.fields[0].values == std::vector<double>{2.5, 4});
  }
}

TEST_CASE("reads compressed arrays whose blocks are all full") {
  CHECK(read_vtu("a.vtu", binary_vtu({.compressed = true, .block = 12})).mesh.tets.size() == 2);
}

TEST_CASE("a binary file that is cut off anywhere is refused, or nothing of the mesh is gone") {
  for (const VtuForm form : {VtuForm{}, VtuForm{.compressed = true}, VtuForm{.appended = true, .raw = true},
                             VtuForm{.appended = true, .compressed = true}}) {
    const std::string whole = binary_vtu(form);
    int accepted = 0;
    for (std::size_t length = 0; length < whole.size(); ++length)
      if (refusal_of(whole.substr(0, length)).empty()) ++accepted;
    CHECK(accepted < 60);  // the closing tags
  }
}

TEST_CASE("binary arrays that cannot be are refused by name, with a remedy") {
  const std::string plain = binary_vtu({}), appended = binary_vtu({.appended = true, .raw = true}),
                    compressed = binary_vtu({.compressed = true});
  CHECK(says(refusal_of(replaced(compressed, "vtkZLib", "vtkLZ4")), {"a.vtu: line", "vtkLZ4", "zlib"}));
  CHECK(says(refusal_of(replaced(appended, "offset=\"0\"", "offset=\"99999\"")), {"'region'", "99999", "cut off"}));
  CHECK(says(refusal_of(replaced(appended, "offset=\"0\"", "offset=\"-1\"")), {"'region'", "'-1'"}));
  CHECK(says(refusal_of(replaced(appended, "<AppendedData", "<AppendedDat")), {"AppendedData", "cut off"}));
  CHECK(says(refusal_of(replaced(appended, "raw", "hex")), {"encoding 'hex'", "raw or base64"}));
  CHECK(says(refusal_of(replaced(plain, "\"Int64\" Name=\"connectivity\"", "\"Float64\" Name=\"connectivity\"")),
              {"'connectivity'", "real", "integers"}));
  CHECK(says(refusal_of(replaced(plain, "\"Int32\" Name=\"offsets\"", "\"Int64\" Name=\"offsets\"")),
              {"'offsets'", "12 bytes"}));
  CHECK(says(refusal_of(replaced(plain, "\nAwAAAA", "\n!wAAAA")), {"'region'", "'!'"}));
}

TEST_CASE("sizes that a file cannot hold are refused before memory is taken") {
  // 2 GB announced before 3 bytes.
  const std::string plain = binary_vtu({}), wide = binary_vtu({.wide_header = true});
  CHECK(says(refusal_of(replaced(plain, "\nAwAAAA", "\n////fw")), {"'region'", "2147483647 bytes", "cut off"}));
  CHECK(says(refusal_of(replaced(wide, "\nAwAAAAAAAAA", "\n/////////38")), {"'region'", "announces"}));
  // A block of 1 GB in 11 compressed bytes.
  const std::string compressed = binary_vtu({.appended = true, .raw = true, .compressed = true});
  const std::string header = samples::Binary(true).integers<int>({1, 16, 3}),
                    bomb = samples::Binary(true).integers<int>({1, 1 << 30, 1 << 30});
  CHECK(says(refusal_of(replaced(compressed, header, bomb)), {"'region'", "1073741824 bytes", "compressed"}));
  const std::string many = samples::Binary(true).integers<int>({1 << 30, 16, 3});
  CHECK(says(refusal_of(replaced(compressed, header, many)), {"'region'", "cut off"}));
}

TEST_CASE("arrays that share one compressed block may not fill the memory") {
  const std::string zeros(1 << 20, '\0'), packed = samples::deflated_block(zeros);
  std::string text =
      "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"0\" NumberOfCells=\"1048576\"><CellData>";
  for (int f = 0; f < 900; ++f)
    text += "<DataArray type=\"Int8\" Name=\"f" + std::to_string(f) + "\" format=\"appended\" offset=\"0\"/>";
  text += "</CellData></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_";
  text += samples::Binary(true).integers<int>({1, 1 << 20, 0, static_cast<long long>(packed.size())});
  CHECK(says(refusal_of(text + packed + "</AppendedData></VTKFile>"), {"announces 1048576 bytes"}));
}

}  // namespace heml::vtk_xml_data_test
