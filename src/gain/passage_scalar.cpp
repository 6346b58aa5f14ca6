#include "gain/passage_walk.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {
namespace {

void walk_ray(const RayWalk& walk, const PassageModel& model, std::size_t i, RayPassages& out) {
  const double near_m = walk.rays->range_min_m[i];
  const double far_m = walk.rays->range_max_m[i];
  RayHits& end = out.end;
  end.kind[i] = HitKind::none;
  end.face[i] = Face::inside;
  end.voxel[i] = {};
  end.distance_m[i] = far_m;
  end.uncertainty[i] = kUnknownUncertainty;

  ScalarRay ray(walk, {end.direction_x[i], end.direction_y[i], end.direction_z[i]});
  double transmittance = 1.0, probability = 0.0, u_distance = 0.0;
  double moment1_m = 0.0, moment2_m2 = 0.0, moment3_m3 = 0.0;
  bool meets_unknown = false, is_blocked = false;
  const auto visit = [&](const PassagePiece& piece) {
    const PassedPiece passed = pass_piece(piece, model.hazards, near_m, transmittance);
    const double p = passed.probability;
    const double s_m = passed.mean_distance_m;
    const double d_focal = std::abs(s_m - model.focal_distance_m);  // Equation (1)
    meets_unknown |= piece.is_unknown && passed.length_m > 0.0;
    probability += p;
    u_distance += p * UncertaintyModel::focal_uncertainty(d_focal);
    moment1_m += p * s_m;
    moment2_m2 += p * s_m * s_m;
    moment3_m3 += p * s_m * s_m * s_m;
    return true;
  };
  const auto ends_at = [&](double leaves_m) {
    is_blocked = leaves_m < near_m;
    return !is_blocked || walk.rays->near_blocking;
  };
  const PassageEnd how =
      walk_passage(walk, model.hazards, ray, end.direction_z[i], far_m, visit, ends_at);
  if (how == PassageEnd::occupied && is_blocked) {
    end.kind[i] = HitKind::blocked;
    transmittance = probability = u_distance = moment1_m = moment2_m2 = moment3_m3 = 0.0;
    meets_unknown = false;
  } else if (how == PassageEnd::occupied) {
    end.kind[i] = HitKind::occupied;
    end.voxel[i] = ray.key();
    end.distance_m[i] = ray.entry_distance_m(near_m);
    end.face[i] = end.distance_m[i] > near_m ? ray.face() : Face::inside;
    const Brick* brick = walk.bricks.brick[walk.bricks.place_of(brick_of(end.voxel[i]))];
    end.uncertainty[i] = brick->states->uncertainty_of_occupied(
        end.voxel[i], static_cast<float>(walk.occupied_uncertainty));
  }
  out.meets_unknown[i] = meets_unknown ? 1 : 0;
  out.end_probability[i] = static_cast<float>(transmittance);
  out.probability[i] = static_cast<float>(probability);
  out.distance_uncertainty[i] = static_cast<float>(u_distance);
  out.moment1_m[i] = static_cast<float>(moment1_m);
  out.moment2_m2[i] = static_cast<float>(moment2_m2);
  out.moment3_m3[i] = static_cast<float>(moment3_m3);
}

void walk_all(const RayWalk& walk, const PassageModel& model, RayPassages& passages) {
  for (std::size_t i = 0; i < walk.rays->size(); ++i) walk_ray(walk, model, i, passages);
}

}  // namespace

PassageKernel scalar_passage_kernel() { return {scalar_kernel().rotate_and_bound, walk_all}; }

}  // namespace nbvopt::detail
