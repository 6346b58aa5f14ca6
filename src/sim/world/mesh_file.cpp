#include "sim/world/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <span>

#include "core/input_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/world/append_mesh.hpp"

namespace nbvopt {

namespace {

/// Tells of the files that are opened.
class OpenedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit OpenedFiles(WorldLog& log) : log_(log) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    log_.read(file);
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  WorldLog& log_;
};

void configure(Assimp::Importer& importer) {
  // Gazebo takes the axes of a file as they are, whatever its up_axis says.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Submeshes are named as users see them in COLLADA, not by ids.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  // A file without meshes would otherwise get one that shows its bones.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                  aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
}

Eigen::Affine3d transform_of(const aiMatrix4x4& matrix) {
  const Eigen::Map<const Eigen::Matrix<ai_real, 4, 4, Eigen::RowMajor>> rows(&matrix.a1);
  return Eigen::Affine3d(rows.cast<double>());
}

TriangleMesh triangles_of(const aiMesh& from) {
  TriangleMesh mesh;
  for (const aiVector3D& vertex : std::span(from.mVertices, from.mNumVertices)) {
    mesh.vertices_m.emplace_back(vertex.x, vertex.y, vertex.z);
  }
  for (const aiFace& face : std::span(from.mFaces, from.mNumFaces)) {
    const std::span corners(face.mIndices, face.mNumIndices);
    const auto exists = [&](unsigned index) { return index < from.mNumVertices; };
    if (corners.size() != 3 || !std::ranges::all_of(corners, exists)) continue;
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return mesh;
}

/// The wanted triangles below a node, each instance of a mesh in its place.
void append_node(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& T_file_parent,
                 const std::string& wanted, TriangleMesh& whole) {
  const Eigen::Affine3d T_file_node = T_file_parent * transform_of(node.mTransformation);
  const auto is_wanted = [&](const aiString& name) { return name.C_Str() == wanted; };
  for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
    const aiMesh& mesh = *scene.mMeshes[index];
    if (wanted.empty() || is_wanted(node.mName) || is_wanted(mesh.mName)) {
      append_mesh(triangles_of(mesh), T_file_node, whole);
    }
  }
  for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) {
    append_node(scene, *child, T_file_node, wanted, whole);
  }
}

void centre(TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) box.extend(vertex_m);
  for (Eigen::Vector3f& vertex_m : mesh.vertices_m) vertex_m -= box.center();
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path, const Submesh& submesh,
                            WorldLog& log) {
  open_input_file(path);  // its messages say why a file cannot be read; Assimp's do not
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string() + ": " + what);
  };
  Assimp::Importer importer;
  configure(importer);
  importer.SetIOHandler(new OpenedFiles(log));  // which the importer owns
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(
        path.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType);
  } catch (const std::exception& error) {
    refuse(std::string("cannot be read as a mesh: ") + error.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    refuse(std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  }
  TriangleMesh mesh;
  append_node(*scene, *scene->mRootNode, Eigen::Affine3d::Identity(), submesh.name, mesh);
  if (mesh.triangles.empty()) {
    refuse(submesh.name.empty() ? "holds no triangle"
                                : "holds no triangle of a submesh '" + submesh.name + "'");
  }
  if (submesh.is_centred) centre(mesh);
  return mesh;
}

}  // namespace nbvopt
