#pragma once
// Binary arrays of VTK XML files: base64 or raw, plain or compressed by zlib. Source: docs.vtk.org, "VTK XML Formats",
// and vtkXMLDataParser.
#include <bit>
#include <heml/mesh/scanner.hpp>
#include <string>
#include <string_view>

namespace heml {

/// How a file encodes its binary arrays, as its VTKFile tag says.
struct VtkXmlCoding {
  std::endian order = std::endian::little;
  std::size_t header_bytes = 4;  ///< of each number that gives a size
  bool compressed = false;
};

/// The bytes of an array.
///
/// @param text      begins with the array, and may go on behind it
/// @param base64    else raw
/// @param limit     compressed arrays of more bytes than this are refused
/// @param in        its fail() reports errors: text that ends too early, sizes that the text cannot hold, damaged data
/// @param what      the array, for messages
/// @param used      the number of characters of `text` that hold the array
std::string vtk_array_bytes(std::string_view text, bool base64, const VtkXmlCoding& coding, std::size_t limit,
                            const Scanner& in, const std::string& what, std::size_t& used);

}  // namespace heml
