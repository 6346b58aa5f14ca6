#include "sim/world/sdf_world.hpp"

#include <Eigen/Geometry>
#include <sdf/Actor.hh>
#include <sdf/Collision.hh>
#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <string>

#include "sim/world/append_mesh.hpp"
#include "sim/world/model_paths.hpp"
#include "sim/world/sdf_document.hpp"
#include "sim/world/sdf_geometry.hpp"
#include "sim/world/sdf_pose.hpp"

namespace nbvopt {

namespace {

/// Walks worlds, models and links, and collects their shapes.
class PartCollector {
 public:
  PartCollector(WorldGeometry geometry, SdfGeometryReader& reader, WorldLog& log)
      : geometry_(geometry), reader_(reader), log_(log) {}

  void add(const sdf::World& from) {
    world_.models = from.ModelCount();
    for (std::uint64_t i = 0; i < from.ModelCount(); ++i) {
      add(*from.ModelByIndex(i), Eigen::Affine3d::Identity(), "");
    }
    for (std::uint64_t i = 0; i < from.ActorCount(); ++i) leave_out(*from.ActorByIndex(i));
  }

  void add(const sdf::Model& model) {
    world_.models = 1;
    add(model, Eigen::Affine3d::Identity(), "");
  }

  SdfWorld take() { return std::move(world_); }

 private:
  void add(const sdf::Model& model, const Eigen::Affine3d& T_map_parent, const std::string& scope) {
    const std::string name = scope + model.Name();
    log_read(model);
    const Eigen::Affine3d T_map_model = T_map_parent * T_parent(model);
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      add(*model.LinkByIndex(i), T_map_model, name);
    }
    world_.nested_models += model.ModelCount();
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      add(*model.ModelByIndex(i), T_map_model, name + "::");
    }
  }

  void add(const sdf::Link& link, const Eigen::Affine3d& T_map_model, const std::string& model) {
    const Eigen::Affine3d T_map_link = T_map_model * T_parent(link);
    if (geometry_ == WorldGeometry::visual) {
      for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
        add_shape(*link.VisualByIndex(i), T_map_link, model);
      }
    } else {
      for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
        add_shape(*link.CollisionByIndex(i), T_map_link, model);
      }
    }
  }

  /// A visual or a collision.
  template <class Shape>
  void add_shape(const Shape& shape, const Eigen::Affine3d& T_map_link, const std::string& model) {
    WorldPart part;
    part.model = model;
    part.is_plane = shape.Geom()->Type() == sdf::GeometryType::PLANE;
    append_mesh(reader_.mesh_of(*shape.Geom(), model), T_map_link * T_parent(shape), part.mesh);
    if (!part.mesh.triangles.empty()) world_.parts.push_back(std::move(part));
  }

  /// An included model's own file, and the one beside it that chose it.
  void log_read(const sdf::Model& model) {
    const std::filesystem::path file = model.Element()->FilePath();
    if (!file.is_absolute()) return;  // the world's own text has no file name
    log_.read(file);
    log_.read(file.parent_path() / "model.config");
  }

  void leave_out(const sdf::Actor& actor) {
    const bool is_found = reader_.find(actor.SkinFilename(), actor.FilePath()).has_value();
    log_.left_out("actor '" + actor.Name() + "' is left out, " +
                  (is_found ? "since it moves"
                            : "its mesh '" + actor.SkinFilename() + "' is not found either"));
  }

  WorldGeometry geometry_;
  SdfGeometryReader& reader_;
  WorldLog& log_;
  SdfWorld world_;
};

}  // namespace

SdfWorld read_sdf_world(const std::filesystem::path& path, const WorldOptions& options,
                        WorldLog& log) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  ModelPaths model_paths(folder, options.model_paths);
  const sdf::Root root = read_sdf_document(path, model_paths, log);
  SdfGeometryReader reader(folder, model_paths, log);
  PartCollector collector(options.geometry, reader, log);
  if (root.WorldCount() == 0) {
    collector.add(*root.Model());
  } else {
    if (root.WorldCount() > 1) log.left_out("only the first world of the file is read");
    collector.add(*root.WorldByIndex(0));
  }
  return collector.take();
}

}  // namespace nbvopt
