#include "sim/world/sdf_documents.hpp"

#include <cstddef>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/world/lower_case.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// Two models that most worlds include and few bring along: a light, and the floor.
constexpr const char* kSun = "sun";
constexpr const char* kGroundPlane = "ground_plane";
constexpr const char* kGroundPlaneSdf =
    "<sdf version='1.6'><model name='ground_plane'><static>true</static><link name='link'>"
    "<collision name='collision'><geometry><plane><normal>0 0 1</normal><size>100 100</size>"
    "</plane></geometry></collision>"
    "<visual name='visual'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>"
    "</geometry></visual></link></model></sdf>";

/// The last part of a URI, as folders of models are named: small letters, no blanks.
std::string short_name(const std::string& uri) {
  std::string name = lower_case(fs::path(uri).lexically_normal().filename().string());
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}

/// "1.10", which is newer than "1.9".
std::pair<int, int> version_of(const SdfElement& sdf) {
  const std::string text = attribute_of(sdf, "version");
  const std::size_t point = text.find('.');
  return {std::atoi(text.c_str()),
          point == std::string::npos ? 0 : std::atoi(text.c_str() + point + 1)};
}

/// The file of a model's folder that its model.config names for the newest version of SDF;
/// model.sdf where that does not say.
fs::path file_in(const fs::path& folder) {
  fs::path otherwise = folder / "model.sdf";
  std::error_code ignored;
  for (const char* name : {"model.config", "manifest.xml"}) {
    if (!fs::exists(folder / name, ignored)) continue;
    try {
      const SdfXml config(read_text_file(folder / name), (folder / name).string());
      std::pair<std::pair<int, int>, fs::path> newest{{-1, 0}, otherwise};
      for (const SdfElement* sdf = config.root()->FirstChildElement("sdf"); sdf != nullptr;
           sdf = sdf->NextSiblingElement("sdf")) {
        const fs::path file = folder / text_of(sdf);
        if (version_of(*sdf) > newest.first && fs::exists(file, ignored)) {
          newest = {version_of(*sdf), file};
        }
      }
      return newest.second;
    } catch (const InputError&) {
      return otherwise;  // a broken model.config does not say
    }
  }
  return otherwise;
}

/// What a file that holds no model holds instead.
std::string instead_of_model(const SdfXml& document) {
  if (is_named(*document.root(), "robot")) return "a URDF: convert it with `gz sdf -p FILE`";
  if (document.is_too_old()) return "SDF 1.0: convert it with `gz sdf -p FILE`";
  if (document.sdf() == nullptr) return "neither a world nor a model";
  const SdfElement* first = document.sdf()->FirstChildElement();
  return first == nullptr ? "nothing" : std::string("a <") + first->Name() + ">";
}

}  // namespace

const SdfElement& SdfDocuments::parse(const std::string& text, const fs::path& file) {
  const auto [document, is_new] = documents_.try_emplace(file, text, file.string());
  const SdfElement* sdf = document->second.sdf();
  if (sdf == nullptr) {
    throw InputError(file.string() + ": cannot be read as SDF: it holds " +
                     instead_of_model(document->second));
  }
  return *sdf;
}

std::vector<SdfModel> SdfDocuments::models_in(const SdfElement& parent, const fs::path& file) {
  std::vector<SdfModel> models;
  for (const SdfElement* child = parent.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (is_named(*child, "model")) {
      models.push_back({.name = attribute_of(*child, "name"),
                        .element = child,
                        .pose = child->FirstChildElement("pose"),
                        .placement_frame = attribute_of(*child, "placement_frame"),
                        .file = file});
    } else if (is_named(*child, "include")) {
      if (std::optional<SdfModel> model = included(*child, file)) models.push_back(*model);
    }
  }
  return models;
}

std::optional<SdfModel> SdfDocuments::included(const SdfElement& include, const fs::path& file) {
  const std::string uri = text_of(include, "uri");
  SdfModel model;
  if (const std::optional<fs::path> found = file_of(uri, file)) {
    model.file = *found;
    model.element = model_of(*found, uri);
  } else {
    model.element = standard_model(uri);
  }
  if (model.element == nullptr) return std::nullopt;
  model.name = text_of(include, "name");
  if (model.name.empty()) model.name = attribute_of(*model.element, "name");
  model.pose = include.FirstChildElement("pose");
  if (model.pose == nullptr) model.pose = model.element->FirstChildElement("pose");
  model.placement_frame = text_of(include, "placement_frame");
  if (model.placement_frame.empty()) {
    model.placement_frame = attribute_of(*model.element, "placement_frame");
  }
  const std::string merge = attribute_of(include, "merge");
  model.is_merged = merge == "true" || merge == "1";
  return model;
}

std::optional<fs::path> SdfDocuments::file_of(const std::string& uri, const fs::path& file) {
  std::optional<fs::path> found = model_paths_.find(uri, file.parent_path());
  if (!found) return std::nullopt;
  std::error_code ignored;
  if (!fs::is_directory(*found, ignored)) return found;
  log_.read(*found / "model.config");
  return file_in(*found);
}

const SdfElement* SdfDocuments::model_of(const fs::path& file, const std::string& uri) {
  const auto [known, is_new] = models_.try_emplace(file, nullptr);
  if (!is_new) return known->second;
  log_.read(file);
  try {
    const auto document = documents_.try_emplace(file, read_text_file(file), file.string()).first;
    const SdfElement* sdf = document->second.sdf();
    known->second = sdf == nullptr ? nullptr : sdf->FirstChildElement("model");
    const bool is_light = sdf != nullptr && sdf->FirstChildElement("light") != nullptr;
    if (known->second == nullptr && !is_light) {
      log_.left_out("model '" + uri + "' is left out: " + file.string() + " holds " +
                    instead_of_model(document->second));
    }
  } catch (const InputError& error) {
    log_.left_out("model '" + uri + "' is left out: " + error.what());
  }
  return known->second;
}

const SdfElement* SdfDocuments::standard_model(const std::string& uri) {
  const std::string name = short_name(uri);
  if (name == kSun) return nullptr;  // gives light, and shows nothing
  if (name == kGroundPlane) {
    log_.remark("model '" + uri + "' is not found, a plane of 100 m at its place stands for it");
    return documents_.try_emplace(kGroundPlane, kGroundPlaneSdf, kGroundPlane)
        .first->second.sdf()
        ->FirstChildElement("model");
  }
  log_.not_found("model '" + uri + "' is not found, " + model_paths_.advice(uri));
  return nullptr;
}

}  // namespace nbvopt
