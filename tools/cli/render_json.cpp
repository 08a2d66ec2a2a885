#include "cli/render_json.hpp"

#include <nlohmann/json.hpp>

namespace hmlfc::cli {

Json camera_json(const Camera& camera) {
  return {
      {"position", {camera.position->u, camera.position->v, camera.position->z}},
      {"look_at", {camera.look_at->u, camera.look_at->v, camera.look_at->z}},
      {"tan_half", *camera.tan_half},
      {"focus", camera.focus},
      {"geometry", geometry_name(camera.aperture == 0 ? camera.geometry : GeometrySource::kPlane)}};
}

Json pass_json(const std::string& name, int levels, const Frame& frame,
               const TouchedBytes* touched) {
  Json json{{"file", name},
            {"levels", levels},
            {"seconds", frame.seconds.total()},
            {"stages",
             {{"plan", frame.seconds.plan},
              {"decode", frame.seconds.decode},
              {"sample", frame.seconds.sample}}},
            {"blocks_needed", frame.counts.blocks_needed},
            {"blocks_decoded", frame.counts.blocks_decoded},
            {"blocks_reused", frame.counts.blocks_reused},
            {"disparities_looked_up", frame.counts.disparities_looked_up}};
  if (touched != nullptr) {
    json["bytes_touched"] = touched->bytes();
    json["key_samples_decoded"] = touched->key_samples();
    json["samples_interpolated"] = frame.counts.samples_interpolated;
  }
  return json;
}

}  // namespace hmlfc::cli
