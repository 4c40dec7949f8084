// Reads surfaces to be drawn by assimp: triangles with texture coordinates, colours and the name of a texture, as they
// are in the file. Source: assimp's documentation, "aiMesh", "Material system".
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdio>
#include <new>

#include "exchange.hpp"

namespace mesher {
namespace {

/// Colour of a mesh's material; grey is assimp's own for meshes without one.
bool material_colour(const aiMaterial& material, aiColor4D& colour) {
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME)
    return false;
  return material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
}

void note_texture(const aiMaterial& material, Skin& skin) {
  aiString name;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) return;
  const std::string texture = name.C_Str();
  if (!skin.texture.empty() && skin.texture != texture)
    throw Failure("names two textures, '" + skin.texture + "' and '" + texture + "': one is drawn");
  if (texture.find('\n') != std::string::npos) throw Failure("names a texture with a line end in it");
  skin.texture = texture;
}

void add_mesh(const aiMesh& mesh, const aiMaterial& material, Skin& skin) {
  const int first = static_cast<int>(skin.surface.nodes.size() / 3);
  aiColor4D colour(1, 1, 1, 1);
  const bool painted = mesh.HasVertexColors(0), coloured = !painted && material_colour(material, colour);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    for (int i = 0; i < 3; ++i) skin.surface.nodes.push_back(mesh.mVertices[v][i]);
    const aiVector3D at = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][v] : aiVector3D();
    skin.looks.insert(skin.looks.end(), {at.x, at.y});
    const aiColor4D c = painted ? mesh.mColors[0][v] : colour;
    skin.looks.insert(skin.looks.end(), {c.r, c.g, c.b});
  }
  skin.has_places = skin.has_places || mesh.HasTextureCoords(0);
  skin.has_colours = skin.has_colours || painted || coloured;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    if (mesh.mFaces[f].mNumIndices == 3)
      for (int i = 0; i < 3; ++i) skin.surface.rows.push_back(first + static_cast<int>(mesh.mFaces[f].mIndices[i]));
}

}  // namespace

Skin read_skin(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
  if (!scene) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw Failure("is no surface assimp can read: " + reason);
  }
  Skin skin;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMaterial& material = *scene->mMaterials[scene->mMeshes[m]->mMaterialIndex];
    note_texture(material, skin);
    add_mesh(*scene->mMeshes[m], material, skin);
  }
  if (skin.surface.rows.empty()) throw Failure("holds no triangles");
  return skin;
}

void write_skin(std::FILE* file, const Skin& skin) {
  const std::size_t count = skin.surface.nodes.size() / 3;
  std::fprintf(file, "%d %d\n%s\n", skin.has_places, skin.has_colours, skin.texture.c_str());
  std::fprintf(file, "%zu %zu\n", count, skin.surface.rows.size() / 3);
  for (std::size_t n = 0; n < count; ++n) {
    const double* x = &skin.surface.nodes[3 * n];
    const float* look = &skin.looks[5 * n];
    std::fprintf(file, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", x[0], x[1], x[2], static_cast<double>(look[0]),
                 static_cast<double>(look[1]), static_cast<double>(look[2]), static_cast<double>(look[3]),
                 static_cast<double>(look[4]));
  }
  for (std::size_t i = 0; i < skin.surface.rows.size(); i += 3)
    std::fprintf(file, "%d %d %d\n", skin.surface.rows[i], skin.surface.rows[i + 1], skin.surface.rows[i + 2]);
  const bool failed = std::ferror(file);
  if (std::fclose(file) != 0 || failed) throw Failure("the helper cannot write its answer");
}

}  // namespace mesher
