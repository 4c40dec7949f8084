#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/write_glb.hpp>
#include <limits>

namespace heml {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

constexpr int gl_float = 5126, gl_unsigned_int = 5125, gl_array_buffer = 34962, gl_element_array_buffer = 34963;

using Vectors = std::vector<Vec3f>;

/// Of the triangles at each node, weighted by their areas.
Vectors normals_of(const std::vector<Triangle>& triangles, const Vectors& positions) {
  Vectors normals(positions.size(), Vec3f::Zero());
  const auto at = [&](int n) { return positions[static_cast<std::size_t>(n)]; };
  for (const Triangle& t : triangles) {
    const Vec3f twice_area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    for (const int n : t) normals[static_cast<std::size_t>(n)] += twice_area;
  }
  for (Vec3f& normal : normals) {
    const float length = normal.norm();
    normal = length > 0 ? Vec3f(normal / length) : Vec3f(Vec3f::UnitY());
  }
  return normals;
}

Vectors difference(const Vectors& a, const Vectors& b) {
  Vectors result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

class GlbWriter {
 public:
  GlbWriter(std::string file, const Animation& animation, const GlbStyle& style)
      : file_(std::move(file)), animation_(animation), style_(style) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "heml"}}}, {"scene", 0}};
    for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) json_[list] = Json::array();
  }

  std::string file_bytes() {
    Json roots = Json::array();
    for (std::size_t p = 0; p < animation_.parts().size(); ++p) {
      roots.push_back(p);
      add_part(p);
    }
    json_["scenes"] = {{{"nodes", roots}}};
    if (!channels_.empty())
      json_["animations"] = {{{"name", "simulation"}, {"channels", channels_}, {"samplers", samplers_}}};
    json_["buffers"] = {{{"byteLength", buffer_.size()}}};
    return assembled();
  }

 private:
  void add_part(std::size_t p) {
    const AnimationPart& part = animation_.parts()[p];
    const std::string name = animation_.parts().size() == 1 ? "body" : fmt::format("body, part {}", p + 1);
    const std::vector<Triangle>& triangles = part.surface.triangles;
    const Vectors& first = part.positions.front();
    const Vectors first_normals = normals_of(triangles, first);
    const Json attributes = {{"POSITION", vectors(first)}, {"NORMAL", vectors(first_normals)}};
    Json targets = Json::array();
    for (std::size_t k = 1; k < part.positions.size(); ++k)
      targets.push_back({{"POSITION", vectors(difference(part.positions[k], first))},
                         {"NORMAL", vectors(difference(normals_of(triangles, part.positions[k]), first_normals))}});
    std::map<int, std::vector<std::uint32_t>> of_region;
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for (const int n : triangles[f]) of_region[part.regions[f]].push_back(static_cast<std::uint32_t>(n));
    Json primitives = Json::array();
    for (const auto& [region, indices] : of_region) {
      Json primitive = {{"attributes", attributes},
                        {"indices", accessor(indices.data(), indices.size(), sizeof(std::uint32_t), gl_unsigned_int,
                                             "SCALAR", gl_element_array_buffer)},
                        {"material", material(region)}};
      if (!targets.empty()) primitive["targets"] = targets;
      primitives.push_back(std::move(primitive));
    }
    json_["meshes"].push_back({{"name", name}, {"primitives", primitives}});
    json_["nodes"].push_back({{"name", name}, {"mesh", p}});
    if (part.times.size() > 1) add_weights(p, part);
    if (animation_.parts().size() > 1) add_presence(p);
  }

  // Target k is whole at frame k + 1, and no target is at frame 0.
  void add_weights(std::size_t p, const AnimationPart& part) {
    const std::size_t frames = part.times.size(), targets = frames - 1;
    std::vector<float> weights(frames * targets, 0);
    for (std::size_t k = 0; k < targets; ++k) weights[(k + 1) * targets + k] = 1;
    json_["meshes"][p]["weights"] = std::vector<float>(targets, 0);
    add_channel(p, "weights", "LINEAR", scalars({part.times.begin(), part.times.end()}, true), scalars(weights, false));
  }

  // Each part is there from its first frame to that of the next.
  void add_presence(std::size_t p) {
    const std::vector<AnimationPart>& parts = animation_.parts();
    const Vec3f here = Vec3f::Ones(), gone = Vec3f::Zero();
    std::vector<float> times;
    Vectors scales;
    if (p > 0) {
      times.push_back(static_cast<float>(parts[0].times[0]));
      scales.push_back(gone);
      json_["nodes"][p]["scale"] = {0, 0, 0};
    }
    times.push_back(static_cast<float>(parts[p].times[0]));
    scales.push_back(here);
    if (p + 1 < parts.size()) {
      times.push_back(static_cast<float>(parts[p + 1].times[0]));
      scales.push_back(gone);
    }
    const int input = scalars(times, true);
    add_channel(p, "scale", "STEP", input, accessor(scales.data(), scales.size(), sizeof(Vec3f), gl_float, "VEC3", 0));
  }

  void add_channel(std::size_t node, const char* what, const char* interpolation, int input, int output) {
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", what}}}});
    samplers_.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  }

  int material(int region) {
    const auto [known, is_new] = materials_.try_emplace(region, static_cast<int>(materials_.size()));
    if (!is_new) return known->second;
    const Vec3f colour = style_.colour(region);
    const auto name = style_.region_names.find(region);
    json_["materials"].push_back(
        {{"name", name == style_.region_names.end() ? fmt::format("region {}", region) : name->second},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {colour[0], colour[1], colour[2], 1}},
           {"metallicFactor", 0},
           {"roughnessFactor", 0.45}}}});
    return known->second;
  }

  int vectors(const Vectors& values) {
    const int index = accessor(values.data(), values.size(), sizeof(Vec3f), gl_float, "VEC3", gl_array_buffer);
    Vec3f low = values.front(), high = values.front();
    for (const Vec3f& value : values) {
      low = low.cwiseMin(value);
      high = high.cwiseMax(value);
    }
    json_["accessors"].back()["min"] = {low[0], low[1], low[2]};
    json_["accessors"].back()["max"] = {high[0], high[1], high[2]};
    return index;
  }

  int scalars(const std::vector<float>& values, bool bounded) {
    const int index = accessor(values.data(), values.size(), sizeof(float), gl_float, "SCALAR", 0);
    if (bounded) {
      json_["accessors"].back()["min"] = {values.front()};
      json_["accessors"].back()["max"] = {values.back()};
    }
    return index;
  }

  int accessor(const void* values, std::size_t count, std::size_t size, int type, const char* shape, int target) {
    const std::size_t begin = buffer_.size(), bytes = count * size;
    expect(begin + bytes);
    buffer_.append(static_cast<const char*>(values), bytes);
    Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes}};
    if (target != 0) view["target"] = target;
    json_["accessors"].push_back(
        {{"bufferView", json_["bufferViews"].size()}, {"componentType", type}, {"count", count}, {"type", shape}});
    json_["bufferViews"].push_back(std::move(view));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  void expect(std::size_t bytes) const {
    if (bytes > std::numeric_limits<std::uint32_t>::max())
      throw InputError(file_, "", "the animation takes more than the 4 GB that a .glb file can hold",
                       "fewer frames a second (--fps)");
  }

  std::string assembled() const {
    std::string text = json_text(json_, file_);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + buffer_.size();
    expect(total);
    std::string bytes = "glTF";
    bytes.reserve(total);
    const auto number = [&](std::size_t value) {
      const auto word = static_cast<std::uint32_t>(value);
      bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    number(2);
    number(total);
    number(text.size());
    bytes += "JSON" + text;
    number(buffer_.size());
    bytes.append("BIN\0", 4);
    return bytes + buffer_;
  }

  std::string file_;
  const Animation& animation_;
  const GlbStyle& style_;
  Json json_, channels_ = Json::array(), samplers_ = Json::array();
  std::map<int, int> materials_;  ///< index by region
  std::string buffer_;            ///< all values take multiples of four bytes
};

}  // namespace

void write_glb(const std::filesystem::path& path, const Animation& animation, const GlbStyle& style) {
  write_file(path, GlbWriter(path.string(), animation, style).file_bytes());
}

}  // namespace heml
