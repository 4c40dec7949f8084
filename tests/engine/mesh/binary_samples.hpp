#pragma once
// The two tetrahedra of samples.hpp in binary forms of .vtu and .msh.
#include <zlib.h>

#include <functional>

#include "engine/mesh/samples.hpp"

namespace heml::samples {

inline std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * static_cast<int>(k)) & 63];
  }
  return text;
}

inline std::string deflated_block(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           static_cast<uLong>(bytes.size()));
  packed.resize(size);
  return packed;
}

struct VtuForm {
  bool appended = false, raw = false, compressed = false, wide_header = false, big_endian = false;
  std::size_t block = 16;  ///< bytes of a compressed block: small, so that arrays have several
};

/// Writes a .vtu file as VTK does: sizes before each array, and before compressed ones those of all blocks.
class VtuFile {
 public:
  explicit VtuFile(const VtuForm& form) : form_(form) {}

  template <class Integer>
  std::string integers(const std::vector<long long>& values) {
    return array(Binary(!form_.big_endian).integers<Integer>(values));
  }
  std::string floats(const std::vector<float>& values) { return array(Binary(!form_.big_endian).floats(values)); }
  const std::string& appended() const { return appended_; }

 private:
  std::string sizes(const std::vector<long long>& values) const {
    return form_.wide_header ? Binary(!form_.big_endian).integers<long long>(values)
                             : Binary(!form_.big_endian).integers<int>(values);
  }
  std::string coded(const std::string& bytes) const { return form_.raw ? bytes : base64(bytes); }

  /// The attributes of an array's tag and its content.
  std::string array(const std::string& bytes) {
    std::string text;
    if (form_.compressed) {
      const long long blocks = static_cast<long long>((bytes.size() + form_.block - 1) / form_.block);
      std::vector<long long> header{blocks, static_cast<long long>(form_.block),
                                    static_cast<long long>(bytes.size() % form_.block)};
      std::string data;
      for (std::size_t at = 0; at < bytes.size(); at += form_.block) {
        const std::string packed = deflated_block(bytes.substr(at, form_.block));
        header.push_back(static_cast<long long>(packed.size()));
        data += packed;
      }
      text = coded(sizes(header)) + coded(data);
    } else {
      text = coded(sizes({static_cast<long long>(bytes.size())}) + bytes);
    }
    if (!form_.appended) return "format=\"binary\">\n" + text + "\n</DataArray>\n";
    appended_ += text;
    return "format=\"appended\" offset=\"" + std::to_string(appended_.size() - text.size()) + "\"/>\n";
  }

  VtuForm form_;
  std::string appended_;
};

inline std::string binary_vtu(const VtuForm& form) {
  VtuFile file(form);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
                     std::string(form.big_endian ? "Big" : "Little") + "Endian\" header_type=\"UInt" +
                     (form.wide_header ? "64" : "32") + "\"" +
                     (form.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                     ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<CellData>\n";
  text += "<DataArray type=\"Int8\" Name=\"region\" " + file.integers<char>({9, 7, -3});
  text += "<DataArray type=\"Float32\" Name=\"stiffness\" " + file.floats({1, 2.5, 4});
  text += "</CellData>\n<Points>\n<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" " +
          file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5});
  text += "</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" " +
          file.integers<long long>({0, 1, 2, 0, 1, 2, 3, 1, 2, 3, 4});
  text += "<DataArray type=\"Int32\" Name=\"offsets\" " + file.integers<int>({3, 7, 11});
  text += "<DataArray type=\"UInt8\" Name=\"types\" " + file.integers<char>({5, 10, 10});
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (form.appended)
    text += "<AppendedData encoding=\"" + std::string(form.raw ? "raw" : "base64") + "\">\n_" + file.appended() +
            "\n</AppendedData>\n";
  return text + "</VTKFile>\n";
}

inline const std::string vtu_base64 = binary_vtu({}), vtu_compressed = binary_vtu({.compressed = true}),
                         vtu_raw = binary_vtu({.appended = true, .raw = true}),
                         vtu_raw_compressed = binary_vtu({.appended = true, .raw = true, .compressed = true});

/// Gmsh 4.1, with parametric nodes, a physical group of two, and a triangle between.
inline std::string gmsh_4_binary(bool little_endian) {
  const auto numbers = [&] { return Binary(little_endian); };
  const auto doubles = [&](const std::vector<double>& values) {
    std::vector<long long> bits;
    for (const double value : values) bits.push_back(__builtin_bit_cast(long long, value));
    return std::string(numbers().integers<long long>(bits));
  };
  std::string text = "$MeshFormat\n4.1 1 8\n" + std::string(numbers().integers<int>({1})) + "\n$EndMeshFormat\n";
  text += "$PhysicalNames\n2\n2 7 \"a face\"\n3 7 \"left lobe\"\n$EndPhysicalNames\n";
  text += "$Entities\n" + std::string(numbers().integers<long long>({1, 0, 1, 2}));
  text += std::string(numbers().integers<int>({1})) + doubles({0, 0, 0}) +
          std::string(numbers().integers<long long>({1}).integers<int>({4}));
  text += std::string(numbers().integers<int>({1})) + doubles({0, 0, 0, 1, 1, 0}) +
          std::string(numbers().integers<long long>({0, 1}).integers<int>({5}));
  text +=
      std::string(numbers().integers<int>({1})) + doubles({0, 0, 0, 1, 1, 1}) +
      std::string(numbers().integers<long long>({1}).integers<int>({7}).integers<long long>({1}).integers<int>({1}));
  text += std::string(numbers().integers<int>({2})) + doubles({0, 0, 0, 1, 1, 2}) +
          std::string(numbers().integers<long long>({2}).integers<int>({-3, 9}).integers<long long>({0}));
  text += "\n$EndEntities\n$Nodes\n" + std::string(numbers().integers<long long>({2, 5, 1, 6}));
  text += std::string(numbers().integers<int>({2, 1, 1}).integers<long long>({1, 1})) + doubles({0, 0, 0, 0.5, 0.5});
  text += std::string(numbers().integers<int>({3, 1, 0}).integers<long long>({4, 2, 3, 5, 6})) +
          doubles({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5});
  text += "\n$EndNodes\n$Elements\n" + std::string(numbers().integers<long long>({3, 3, 1, 3}));
  text += std::string(numbers().integers<int>({2, 1, 2}).integers<long long>({1, 1, 1, 2, 3}));
  text += std::string(numbers().integers<int>({3, 1, 4}).integers<long long>({1, 2, 1, 2, 3, 5}));
  text += std::string(numbers().integers<int>({3, 2, 4}).integers<long long>({1, 3, 2, 3, 5, 6}));
  text += "\n$EndElements\n$ElementData\n1\n\"stiffness\"\n1\n0.0\n3\n0\n1\n2\n";
  text += std::string(numbers().integers<int>({2})) + doubles({2.5}) + std::string(numbers().integers<int>({3})) +
          doubles({4});
  return text + "\n$EndElementData\n$Periodic\n" + std::string(numbers().integers<long long>({0})) + "\n$EndPeriodic\n";
}

/// Gmsh 2.2.
inline std::string gmsh_2_binary() {
  const auto numbered_node = [](int number, std::vector<double> x) {
    std::vector<long long> bits;
    for (const double value : x) bits.push_back(__builtin_bit_cast(long long, value));
    return std::string(Binary(true).integers<int>({number}).integers<long long>(bits));
  };
  std::string text = "$MeshFormat\n2.2 1 8\n" + std::string(Binary(true).integers<int>({1})) + "\n$EndMeshFormat\n";
  text += "$PhysicalNames\n1\n3 7 \"left lobe\"\n$EndPhysicalNames\n$Nodes\n5\n" + numbered_node(40, {0, 0, 0}) +
          numbered_node(20, {1, 0, 0}) + numbered_node(21, {0, 1, 0}) + numbered_node(33, {0, 0, 1}) +
          numbered_node(10, {1, 1, 1.5});
  text += "\n$EndNodes\n$Elements\n3\n" + std::string(Binary(true).integers<int>({2, 1, 2, 1, 7, 1, 40, 20, 21}));
  text += std::string(Binary(true).integers<int>({4, 2, 2, 2, 7, 1, 40, 20, 21, 33, 4, -3, 2, 20, 21, 33, 10}));
  return text + "\n$EndElements\n";
}

inline const std::string abaqus = R"(*HEADING
two tetrahedra, 1
** Elements before their nodes, and in sets.
*Element, type=C3D4, ELSET = left lobe
 7, 10, 20, 30, 40
*ELEMENT, TYPE=S3
 8, 10, 20, 30
*ELEMENT, TYPE=C3D4H
 12, 20, 30, 40, 55
*NODE, NSET=all
10, 0, 0, 0
20, 1., 0
30, , 1.e+0, 0
40, 0, 0, +1
55, 1, 1, 1.5
*ELSET, ELSET=both, GENERATE
7, 12, 5
*ELSET, ELSET=right
12,
*NODE PRINT, NSET=all
U
*STEP
*END STEP
)";

}  // namespace heml::samples
