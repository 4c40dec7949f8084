#include <heml/mesh/mesh_text.hpp>
#include <heml/scenario/write_usda.hpp>

namespace heml {
namespace {

/// Puts ", " between items.
class UsdaList {
 public:
  explicit UsdaList(MeshText& out) : out_(out) { out_.add("["); }
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    if (!first_) out_.add(", ");
    first_ = false;
    out_.add(format, std::forward<Args>(args)...);
  }
  void end() { out_.add("]"); }

 private:
  MeshText& out_;
  bool first_ = true;
};

void add_points(MeshText& out, const std::vector<Vec3f>& points) {
  UsdaList list(out);
  for (const Vec3f& x : points) list.add("({:.9g}, {:.9g}, {:.9g})", x[0], x[1], x[2]);
  list.end();
}

/// points, and the box around them that UsdGeomBoundable wants.
void add_samples(MeshText& out, const AnimationPart& part, double fps, bool skin) {
  std::vector<std::vector<Vec3f>> frames;
  for (const std::vector<Vec3f>& positions : part.positions) {
    std::vector<Vec3f>& points = frames.emplace_back();
    if (!skin) points = positions;
    for (std::size_t i = 0; skin && i < part.surface.nodes.size(); ++i)
      points.push_back(positions[static_cast<std::size_t>(part.surface.nodes[i])]);
  }
  out.add("            point3f[] points.timeSamples = {{\n");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    out.add("                {:.17g}: ", part.times[k] * fps);
    add_points(out, frames[k]);
    out.add(",\n");
  }
  out.add("            }}\n            float3[] extent.timeSamples = {{\n");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    Vec3f low = frames[k][0], high = low;
    for (const Vec3f& x : frames[k]) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    out.add("                {:.17g}: ", part.times[k] * fps);
    add_points(out, {low, high});
    out.add(",\n");
  }
  out.add("            }}\n");
}

void add_tissue(MeshText& out, const AnimationPart& part, double fps) {
  out.add("        def TetMesh \"tissue\"\n        {{\n            uniform token purpose = \"guide\"\n");
  out.add("            uniform token orientation = \"rightHanded\"\n            int4[] tetVertexIndices = ");
  UsdaList tets(out);
  for (const Tet& t : part.tets) tets.add("({}, {}, {}, {})", t[0], t[1], t[2], t[3]);
  tets.end();
  out.add("\n            int3[] surfaceFaceVertexIndices = ");
  UsdaList faces(out);
  const auto node = [&](int n) { return part.surface.nodes[static_cast<std::size_t>(n)]; };
  for (const Triangle& t : part.surface.triangles) faces.add("({}, {}, {})", node(t[0]), node(t[1]), node(t[2]));
  faces.end();
  out.add("\n            int[] primvars:region = ");
  UsdaList regions(out);
  for (const int region : part.tet_regions) regions.add("{}", region);
  regions.end();
  out.add(" (\n                interpolation = \"uniform\"\n            )\n");
  add_samples(out, part, fps, false);
  out.add("        }}\n");
}

void add_skin(MeshText& out, const AnimationPart& part, double fps, const std::function<Vec3f(int)>& colour) {
  out.add("        def Mesh \"skin\"\n        {{\n            uniform token subdivisionScheme = \"none\"\n");
  out.add("            uniform token orientation = \"rightHanded\"\n            int[] faceVertexCounts = ");
  UsdaList counts(out);
  for (std::size_t f = 0; f < part.surface.triangles.size(); ++f) counts.add("3");
  counts.end();
  out.add("\n            int[] faceVertexIndices = ");
  UsdaList corners(out);
  for (const Triangle& t : part.surface.triangles) corners.add("{}, {}, {}", t[0], t[1], t[2]);
  corners.end();
  out.add("\n            color3f[] primvars:displayColor = ");
  std::vector<Vec3f> colours;
  for (const int region : part.regions) colours.push_back(colour(region));
  add_points(out, colours);
  out.add(" (\n                interpolation = \"uniform\"\n            )\n");
  add_samples(out, part, fps, true);
  out.add("        }}\n");
}

/// From the part's first frame to that of the next.
void add_visibility(MeshText& out, const std::vector<AnimationPart>& parts, std::size_t p, double fps) {
  if (parts.size() == 1) return;
  out.add("        token visibility.timeSamples = {{\n");
  if (p > 0) out.add("            {:.17g}: \"invisible\",\n", parts[0].times[0] * fps);
  out.add("            {:.17g}: \"inherited\",\n", parts[p].times[0] * fps);
  if (p + 1 < parts.size()) out.add("            {:.17g}: \"invisible\",\n", parts[p + 1].times[0] * fps);
  out.add("        }}\n");
}

}  // namespace

void write_usda(const std::filesystem::path& path, const Animation& animation, double fps,
                const std::function<Vec3f(int region)>& colour) {
  const std::vector<AnimationPart>& parts = animation.parts();
  MeshText out;
  out.add("#usda 1.0\n(\n    defaultPrim = \"body\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n");
  out.add("    startTimeCode = {:.17g}\n    endTimeCode = {:.17g}\n    timeCodesPerSecond = {:.17g}\n)\n",
          parts.front().times.front() * fps, parts.back().times.back() * fps, fps);
  out.add("\ndef Xform \"body\"\n{{\n");
  for (std::size_t p = 0; p < parts.size(); ++p) {
    out.add("    def Xform \"part_{}\"\n    {{\n", p + 1);
    add_visibility(out, parts, p, fps);
    add_tissue(out, parts[p], fps);
    add_skin(out, parts[p], fps, colour);
    out.add("    }}\n");
  }
  out.add("}}\n");
  out.save(path);
}

}  // namespace heml
