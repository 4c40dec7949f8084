// Reads surfaces by assimp, without its steps JoinIdenticalVertices and FindDegenerates: they merge vertices within
// 1e-5 and drop triangles with an area below 1e-6, which are 10 µm and 1 mm² in metres. The engine merges equal nodes
// itself.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <new>

#include "exchange.hpp"

namespace mesher {

Exchange read_surface(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  constexpr int all_but_meshes = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                 aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                 aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS |
                                 aiComponent_MATERIALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, all_but_meshes);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
  if (!scene) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw Failure("is no surface assimp can read: " + reason);
  }
  Exchange surface;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const int first = static_cast<int>(surface.nodes.size() / 3);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      for (int i = 0; i < 3; ++i) surface.nodes.push_back(mesh.mVertices[v][i]);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      if (mesh.mFaces[f].mNumIndices == 3)
        for (int i = 0; i < 3; ++i) surface.rows.push_back(first + static_cast<int>(mesh.mFaces[f].mIndices[i]));
  }
  if (surface.rows.empty()) throw Failure("holds no triangles");
  return surface;
}

}  // namespace mesher
