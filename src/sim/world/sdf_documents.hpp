// SDF files, each parsed once, and the models in them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/world/model_paths.hpp"
#include "sim/world/sdf_xml.hpp"
#include "sim/world/world_log.hpp"

namespace nbvopt {

/// A model where it stands: declared in place, or included from another file.
struct SdfModel {
  std::string name;
  const SdfElement* element = nullptr;  ///< <model>
  const SdfElement* pose = nullptr;     ///< the <pose> that counts; null: none
  std::string placement_frame = {};     ///< whose pose that is; empty: the model's own
  std::filesystem::path file = {};      ///< that declares it
  bool is_merged = false;               ///< its links and frames are its parent's
};

/// Finds, parses and keeps the files that worlds include. What cannot be had is logged.
class SdfDocuments {
 public:
  /// Both must outlive it, and it the models that it gives.
  SdfDocuments(ModelPaths& model_paths, WorldLog& log) : model_paths_(model_paths), log_(log) {}

  /// A document from a text that was read; paths in it are relative to the file's folder. Throws
  /// InputError as SdfXml does, and when it is not SDF.
  const SdfElement& parse(const std::string& text, const std::filesystem::path& file);

  /// The models that are direct children of an element, in order.
  std::vector<SdfModel> models_in(const SdfElement& parent, const std::filesystem::path& file);

  ModelPaths& model_paths() { return model_paths_; }
  WorldLog& log() { return log_; }

 private:
  std::optional<SdfModel> included(const SdfElement& include, const std::filesystem::path& file);
  std::optional<std::filesystem::path> file_of(const std::string& uri,
                                               const std::filesystem::path& file);
  /// <model> of a file; null, and logged, where there is none.
  const SdfElement* model_of(const std::filesystem::path& file, const std::string& uri);
  const SdfElement* standard_model(const std::string& uri);

  ModelPaths& model_paths_;
  WorldLog& log_;
  std::map<std::filesystem::path, SdfXml> documents_;
  std::map<std::filesystem::path, const SdfElement*> models_;  // by file, null: there is none
};

}  // namespace nbvopt
