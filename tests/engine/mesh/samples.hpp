#pragma once
// Two tetrahedra in every format: nodes 0..4, elements {0,1,2,3} of region 7 and {1,2,3,4} of region −3. Written by
// hand from the format specifications, with peculiarities of real files (gaps in numbering, comments, other cells
// between).
#include <array>
#include <string>
#include <vector>

namespace heml::samples {

inline const std::string feb = R"(<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="2.5">
  <Geometry>
    <!-- two tetrahedra and a shell -->
    <Nodes name="Object01">
      <node id="10">0,0,0</node>
      <node id="20"> 1, 0, 0 </node>
      <node id="21">0,1,0</node>
      <node id="33">0,0,1</node>
      <node id="40">1,1,1.5</node>
    </Nodes>
    <Elements type="tet4" mat="1" name="left lobe">
      <elem id="3">10,20,21,33</elem>
    </Elements>
    <Elements type="tet4" mat="2" name="right">
      <elem id="7">20,21,33,40</elem>
    </Elements>
    <Elements type="tri3" mat="3" name="skin">
      <elem id="8">10,20,21</elem>
    </Elements>
    <NodeSet name="base"><node id="10"/><node id="20"/></NodeSet>
    <Surface name="under"><tri3 id="1">10,21,20</tri3></Surface>
  </Geometry>
</febio_spec>
)";

inline const std::string gmsh_1 = R"($NOD
5
10 0 0 0
20 1 0 0
21 0 1 0
33 0 0 1
40 1 1 1.5
$ENDNOD
$ELM
3
1 2 1 1 3 10 20 21
2 4 7 1 4 10 20 21 33
3 4 -3 2 4 20 21 33 40
$ENDELM
)";

inline const std::string gmsh_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "left lobe"
$EndPhysicalNames
$Nodes
5
40 0 0 0
20 1 0 0
21 0 1 0
33 0 0 1
10 1 1 1.5
$EndNodes
$Elements
4
1 15 2 0 1 40
2 4 2 7 1 40 20 21 33

3 2 0 40 20 21
4 4 3 -3 2 5 20 21 33 10
$EndElements
)";

inline const std::string gmsh_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 0 1 2
1 0 0 0 0
1 0 0 0 1 1 0 0 0
1 0 0 0 1 1 1 1 7 1 1
2 0 0 0 1 1 1 2 -3 9 0
$EndEntities
$Nodes
2 5 1 6
0 1 0 1
1
0 0 0
3 1 0 4
2
3
5
6
1 0 0
0 1 0
0 0 1
1 1 1.5
$EndNodes
$Elements
3 3 1 3
2 1 2 1
1 1 2 3
3 1 4 1
2 1 2 3 5
3 2 4 1
3 2 3 5 6
$EndElements
)";

/// Data of elements a (region 7) and b (region −3): stiffness 2.5 and 4; fibre (1, 0, 0) and (0, −0.6, 0.8); a later
/// time step of the stiffness; a field of nine components; and data of a cell that is no tetrahedron.
inline std::string gmsh_data(const std::string& a, const std::string& b) {
  return R"($ElementData
1
"stiffness"
1
0.0
3
0
1
3
1 9
)" + a + " 2.5\n" +
         b + R"( 4
$EndElementData
$ElementData
2
"fibre direction"
"scheme"
0
4
0 3 2 0
)" + b + " 0 -0.6 0.8\n" +
         a + R"( 1 0 0
$EndElementData
$ElementData
1
"stiffness"
1
0.5
3
1
1
1
)" + a + R"( 77
$EndElementData
$ElementData
1
"stress"
0
3
0
9
1
)" + a + R"( 1 2 3 4 5 6 7 8 9
$EndElementData
$ElementData
1
"of another cell"
0
3
0
1
1
1 5
$EndElementData
)";
}

inline const std::string gmsh_2_data = gmsh_2 + gmsh_data("2", "4");
inline const std::string gmsh_4_data = gmsh_4 + gmsh_data("2", "3");

inline const std::string medit = R"(MeshVersionFormatted 2 # a comment

Dimension
3

# nodes
Vertices
5
0 0 0 0
1 0 0 0   # the second
0 1 0 0
0 0 1 0

1 1 1.5 12
Triangles
1
1 2 3 5
Tetrahedra
2
1 2 3 4 7
2 3 4 5 -3
End
)";

inline const std::string vtk = R"(# vtk DataFile Version 3.0
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0  1 0 0  0 1 0
0 0 1  1 1 1.5
CELLS 3 14
3 0 1 2
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 3
5 10 10
POINT_DATA 5
VECTORS displacement double
0 0 0 0 0 0 0 0 0 0 0 0 0 0 0
CELL_DATA 3
SCALARS quality float
LOOKUP_TABLE default
1 1 0.5
FIELD FieldData 2
other 2 3 int
1 2 3 4 5 6
region 1 3 int
9 7 -3
VECTORS fibre%20direction float
7 7 7 1 0 0 0 -0.6 0.8
SCALARS stiffness double 1
LOOKUP_TABLE default
nan 2.5 4
SCALARS pair double 2
LOOKUP_TABLE default
1 2 3 4 5 6
)";

inline const std::string vtk_5 = R"(# vtk DataFile Version 5.1
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1.5
METADATA
INFORMATION 0

CELLS 3 8
OFFSETS vtktypeint64
0 4 8
CONNECTIVITY vtktypeint64
0 1 2 3 1 2 3 4
CELL_TYPES 2
10 10
CELL_DATA 2
SCALARS region int
LOOKUP_TABLE default
7 -3
)";

inline const std::string vtu = R"(<?xml version="1.0"?>
<!-- two <tetrahedra> -->
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="3">
      <PointData><DataArray type="Float32" Name="region" format="ascii">1 1 1 1 1</DataArray></PointData>
      <CellData Scalars="region">
        <DataArray type="Int32" Name="region" format="ascii">9 7 -3</DataArray>
      </CellData>
      <Points>
        <DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
          0 0 0 1 0 0 0 1 0 0 0 1 1 1 1.5</DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 1 2  0 1 2 3  1 2 3 4</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3 7 11</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5 10 10</DataArray>
      </Cells>
      <CellData>
        <DataArray type="Float64" Name="stiffness" format="ascii">nan 2.5 4</DataArray>
        <DataArray type="Float32" Name="fibre direction" format="ascii" NumberOfComponents="3">
          7 7 7 1 0 0 0 -0.6 0.8</DataArray>
        <DataArray type="Int8" Name="a &lt;&quot;&amp;&apos;&gt; b" format="ascii">1 2 3</DataArray>
        <DataArray type="String" Name="packed" format="binary">AAAA</DataArray>
      </CellData>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

inline const std::string node = R"(# nodes
5 3 1 1
1 0 0 0 0.5 0
2 1 0 0 0.5 0
3 0 1 0 0.5 0
4 0 0 1 0.5 1
5 1 1 1.5 0.5 1
# end
)";

inline const std::string ele = R"(2 4 1
1 1 2 3 4 7
2 2 3 4 5 -3.0
)";

/// The same elements with two further attributes.
inline const std::string ele_attributes = R"(2 4 3
1 1 2 3 4 7 2.5 -1
2 2 3 4 5 -3.0 4 inf
)";

/// Builds binary files from text and numbers.
class Binary {
 public:
  explicit Binary(bool little_endian = false) : little_endian_(little_endian) {}
  Binary& text(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  template <class Integer>
  Binary& integers(const std::vector<long long>& values) {
    for (long long value : values)
      for (std::size_t i = 0; i < sizeof(Integer); ++i) {
        const std::size_t byte = little_endian_ ? i : sizeof(Integer) - 1 - i;
        bytes_ += static_cast<char>(static_cast<unsigned long long>(value) >> (8 * byte) & 0xff);
      }
    return *this;
  }
  Binary& floats(const std::vector<float>& values) {
    for (float value : values) integers<int>({static_cast<long long>(__builtin_bit_cast(unsigned, value))});
    return *this;
  }
  operator std::string() const { return bytes_; }

 private:
  bool little_endian_;
  std::string bytes_;
};

/// The legacy VTK sample in binary, which is big-endian.
inline const std::string vtk_binary =
    Binary()
        .text("# vtk DataFile Version 2.0\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n")
        .floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5})
        .text("\nCELLS 2 10\n")
        .integers<int>({4, 0, 1, 2, 3, 4, 1, 2, 3, 4})
        .text("\nCELL_TYPES 2\n")
        .integers<int>({10, 10})
        .text("\nCELL_DATA 2\nSCALARS region short\nLOOKUP_TABLE default\n")
        .integers<short>({7, -3})
        .text("\n");

inline const std::string vtk_5_binary =
    Binary()
        .text("# vtk DataFile Version 5.1\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n")
        .floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5})
        .text("\nCELLS 3 8\nOFFSETS vtktypeint64\n")
        .integers<long long>({0, 4, 8})
        .text("\nCONNECTIVITY vtktypeint64\n")
        .integers<long long>({0, 1, 2, 3, 1, 2, 3, 4})
        .text("\nCELL_TYPES 2\n")
        .integers<int>({10, 10})
        .text("\nCELL_DATA 2\nFIELD FieldData 2\nheat 1 2 float\n")
        .floats({1, 2})
        .text("\nMETADATA\nINFORMATION 0\n\nregion 1 2 vtktypeint64\n")
        .integers<long long>({7, -3})
        .text("\nVECTORS fibre%20direction float\n")
        .floats({1, 0, 0, 0, -0.5f, 0.75f})
        .text("\nSCALARS count unsigned_char\nLOOKUP_TABLE default\n")
        .integers<char>({200, 3})
        .text("\n");

/// The surface of the tetrahedron {0,1,2,3}.
inline const std::string ply = R"(ply
format ascii 1.0
comment a surface
obj_info of a tetrahedron
element vertex 4
property float x
property float y
property double z
element face 4
property list uint int vertex_indices
property uchar red
element edge 0
property int vertex1
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1 255
3 0 1 3 0
3 1 2 3 0
3 0 3 2 0
)";

inline std::string binary_ply(bool little_endian) {
  Binary file(little_endian);
  file.text("ply\nformat binary_" + std::string(little_endian ? "little" : "big") + "_endian 1.0\n")
      .text("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n")
      .text("element face 4\nproperty list short uint vertex_indices\nend_header\n")
      .floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    file.integers<short>({3}).integers<int>({a, b, c});
  return file;
}
inline const std::string ply_little_endian = binary_ply(true), ply_big_endian = binary_ply(false);

}  // namespace heml::samples
