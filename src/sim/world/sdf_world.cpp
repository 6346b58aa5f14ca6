#include "sim/world/sdf_world.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "sim/world/append_mesh.hpp"
#include "sim/world/model_paths.hpp"
#include "sim/world/sdf_actor.hpp"
#include "sim/world/sdf_documents.hpp"
#include "sim/world/sdf_frames.hpp"
#include "sim/world/sdf_geometry.hpp"
#include "sim/world/sdf_population.hpp"
#include "sim/world/sdf_state.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// What files that include each other can ask for without end. More is no world that can be cast
/// at.
constexpr std::uint64_t kModelsMax = 1'000'000;
constexpr std::uint64_t kTrianglesMax = 50'000'000;

/// Of the numbers that random populations draw.
constexpr std::uint64_t kPopulationSeed = 1;

/// Saved numbers have six digits: where they say what was declared, the latter, more exact, counts.
Eigen::Affine3d saved_unless_same(const Eigen::Affine3d& T_saved,
                                  const Eigen::Affine3d& T_declared) {
  constexpr double kRounding = 1e-4;  // metres, and of a rotation's matrix
  const auto difference = (T_saved.matrix() - T_declared.matrix()).cwiseAbs();
  return difference.maxCoeff() < kRounding ? T_declared : T_saved;
}

/// Walks worlds, models and links, and collects their shapes.
class PartCollector {
 public:
  PartCollector(WorldGeometry geometry, SdfDocuments& documents)
      : shape_kind_(geometry == WorldGeometry::visual ? "visual" : "collision"),
        documents_(documents),
        log_(documents.log()),
        reader_(documents.model_paths(), documents.log()) {}

  void add_world(const SdfElement& world, const fs::path& file) {
    SdfFrames frames(world, file, "the world", documents_);
    const SdfState state(world, log_);
    add_models(documents_.models_in(world, file), frames, state);
    add_populations(world, file, state);
    if (const SdfElement* insertions = state.insertions()) {
      add_models(documents_.models_in(*insertions, file), frames, state);
    }
    for_each(world, "actor", [&](const SdfElement& actor) { add_actor(actor, frames, file); });
    if (world_.people.persons.empty()) world_.people.models.clear();
    for_each(world, "road", [&](const SdfElement& road) {
      log_.left_out("road '" + attribute_of(road, "name") +
                    "' is left out: it is flat and lies on the ground");
    });
  }

  void add_only_model(const SdfElement& sdf, const fs::path& file) {
    SdfFrames frames(sdf, file, "the file", documents_);
    std::vector<SdfModel> models = documents_.models_in(sdf, file);
    models.resize(1);
    add_models(models, frames, SdfState());
  }

  SdfWorld take() { return std::move(world_); }

 private:
  /// A model on the way down from the world.
  struct Place {
    Eigen::Affine3d T_map_parent = Eigen::Affine3d::Identity();
    std::string scope = {};                ///< of the name: "outer::"
    const SdfModelState* state = nullptr;  ///< what was saved of the model
    int depth = 0;
  };

  template <class Function>
  static void for_each(const SdfElement& parent, const char* name, Function function) {
    for (const SdfElement* child = parent.FirstChildElement(name); child != nullptr;
         child = child->NextSiblingElement(name)) {
      function(*child);
    }
  }

  /// Adds a part, or logs why it cannot be had.
  template <class Add>
  void try_to_add(const std::string& part, const fs::path& file, Add add) {
    try {
      add();
    } catch (const InputError& error) {
      log_.left_out(part + " is left out: " + file.string() + ": " + error.what());
    }
  }

  /// The first of two with the same name counts, as in Gazebo; what has no name always does.
  bool is_new(std::set<std::string>& names, const std::string& name, const std::string& what) {
    if (name.empty() || names.insert(name).second) return true;
    log_.left_out(what + " is left out: one with this name already exists");
    return false;
  }

  void add_models(const std::vector<SdfModel>& models, SdfFrames& frames, const SdfState& state) {
    for (const SdfModel& model : models) {
      if (state.is_deleted(model.name)) continue;
      if (!is_new(names_, model.name, "model '" + model.name + "'")) continue;
      ++world_.models;
      add(model, frames, {.state = state.model(model.name)});
    }
  }

  void add_populations(const SdfElement& world, const fs::path& file, const SdfState& state) {
    std::mt19937_64 generator(kPopulationSeed);
    for_each(world, "population", [&](const SdfElement& population) {
      const std::string what = "population '" + attribute_of(population, "name") + "'";
      try_to_add(what, file, [&] {
        const std::vector<SdfModel> models = documents_.models_in(population, file);
        if (models.empty()) throw InputError("there is no model in it");
        const auto positions_m = population_positions_m(population, generator);
        for (std::size_t i = 0; i < positions_m.size(); ++i) {
          add_clone(models.front(), i, positions_m[i], state);
        }
      });
    });
  }

  /// A copy's own pose is that of its place.
  void add_clone(SdfModel model, std::size_t number, const Eigen::Vector3d& position_map_m,
                 const SdfState& state) {
    model.name += "_clone_" + std::to_string(number);
    model.pose = nullptr;
    model.placement_frame.clear();
    if (state.is_deleted(model.name)) return;
    ++world_.models;
    SdfFrames frames(*model.element, model.file, "the world", documents_);
    add(model, frames,
        {.T_map_parent = Eigen::Affine3d(Eigen::Translation3d(position_map_m)),
         .state = state.model(model.name)});
  }

  void add(const SdfModel& model, SdfFrames& outer, const Place& place) {
    const std::string name = place.scope + model.name;
    if (is_full()) return;
    try_to_add("model '" + name + "'", model.file, [&] {
      constexpr int kDepthMax = 64;
      if (place.depth == kDepthMax) {
        throw InputError("models are too deep in each other, does it include itself?");
      }
      Eigen::Affine3d T_map_model = place.T_map_parent * outer.T_scope(model);
      if (place.state != nullptr && place.state->T_map_model) {
        T_map_model = saved_unless_same(*place.state->T_map_model, T_map_model);
      }
      if (place.depth == 0) {
        world_.people.models.push_back({model.name, T_map_model.translation()});
      }
      add_inside(model, name, T_map_model, place);
    });
  }

  void add_inside(const SdfModel& model, const std::string& name,
                  const Eigen::Affine3d& T_map_model, const Place& place) {
    SdfFrames frames(*model.element, model.file, "model '" + name + "'", documents_);
    std::set<std::string> links;
    for_each(*model.element, "link", [&](const SdfElement& link) {
      const std::string what = "model '" + name + "': link '" + attribute_of(link, "name") + "'";
      if (!is_new(links, attribute_of(link, "name"), what)) return;
      try_to_add(what, model.file, [&] {
        add_link(link, {model, name, frames, T_map_model, place.state});
      });
    });
    std::set<std::string> models;
    for (const SdfModel& nested : documents_.models_in(*model.element, model.file)) {
      if (!is_new(models, nested.name, "model '" + name + "::" + nested.name + "'")) continue;
      ++world_.nested_models;
      add(nested, frames,
          {.T_map_parent = T_map_model,
           .scope = name + "::",
           .state = nested_state(place.state, nested.name),
           .depth = place.depth + 1});
    }
  }

  /// A model whose links are added.
  struct Owner {
    const SdfModel& model;
    const std::string& name;
    SdfFrames& frames;
    const Eigen::Affine3d& T_map_model;
    const SdfModelState* state;
  };

  void add_link(const SdfElement& link, const Owner& owner) {
    Eigen::Affine3d T_model_link = owner.frames.T_scope(link.FirstChildElement("pose"));
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    if (owner.state != nullptr) {
      scale = owner.state->scale;
      const auto saved = owner.state->T_map_link.find(attribute_of(link, "name"));
      if (saved != owner.state->T_map_link.end()) {
        T_model_link = saved_unless_same(owner.T_map_model.inverse() * saved->second, T_model_link);
      }
    }
    std::set<std::string> shapes;
    for_each(link, shape_kind_, [&](const SdfElement& shape) {
      const std::string what =
          "model '" + owner.name + "': " + shape_kind_ + " '" + attribute_of(shape, "name") + "'";
      if (!is_new(shapes, attribute_of(shape, "name"), what)) return;
      try_to_add(what, owner.model.file, [&] { add_shape(shape, T_model_link, scale, owner); });
    });
  }

  /// A visual or a collision.
  void add_shape(const SdfElement& shape, const Eigen::Affine3d& T_model_link,
                 const Eigen::Vector3d& scale, const Owner& owner) {
    const SdfElement* geometry = shape.FirstChildElement("geometry");
    if (geometry == nullptr) return;
    const Eigen::Affine3d T_model_shape =
        owner.frames.T_scope(shape.FirstChildElement("pose"), T_model_link);
    const SdfShape made = reader_.shape_of(*geometry, owner.model.file, owner.name, scale);
    WorldPart part{.model = owner.name, .mesh = {}, .is_plane = made.is_plane};
    append_mesh(made.mesh, owner.T_map_model * T_model_shape, part.mesh);
    if (part.mesh.triangles.empty()) return;
    triangles_ += part.mesh.triangles.size();
    world_.parts.push_back(std::move(part));
  }

  bool is_full() {
    if (world_.models + world_.nested_models <= kModelsMax && triangles_ <= kTrianglesMax) {
      return false;
    }
    log_.left_out("models are left out: there are more than " + std::to_string(kModelsMax) +
                  ", or they have more than " + std::to_string(kTrianglesMax) + " triangles");
    return true;
  }

  void add_actor(const SdfElement& actor, SdfFrames& frames, const fs::path& file) {
    const std::string what = "actor '" + attribute_of(actor, "name") + "'";
    if (!is_new(names_, attribute_of(actor, "name"), what)) return;
    try_to_add(what, file, [&] { world_.people.persons.push_back(actor_of(actor, frames)); });
  }

  const char* shape_kind_;
  SdfDocuments& documents_;
  WorldLog& log_;
  SdfGeometryReader reader_;
  SdfWorld world_;
  std::set<std::string> names_;
  std::uint64_t triangles_ = 0;
};

}  // namespace

SdfWorld read_sdf_world(const std::string& text, const fs::path& path, const WorldOptions& options,
                        WorldLog& log) {
  const fs::path file = fs::absolute(path);
  ModelPaths model_paths(file.parent_path(), options.model_paths);
  SdfDocuments documents(model_paths, log);
  const SdfElement& sdf = documents.parse(text, file);
  PartCollector collector(options.geometry, documents);
  if (const SdfElement* world = sdf.FirstChildElement("world")) {
    if (world->NextSiblingElement("world") != nullptr) {
      log.left_out("only the first world of the file is read");
    }
    collector.add_world(*world, file);
  } else if (sdf.FirstChildElement("model") != nullptr) {
    collector.add_only_model(sdf, file);
  } else {
    throw InputError(path.string() +
                     ": cannot be read as SDF: there is neither a world nor a model in it");
  }
  return collector.take();
}

}  // namespace nbvopt
