#include "encoder/extended_session.hpp"

#include "encoder/disparity_probe.hpp"
#include "encoder/extended_targets.hpp"
#include "encoder/stream_assembly.hpp"

namespace hmlfc {

ExtendedStream encode_extended(const LightField& light_field, const StreamHeader& header,
                               const EncodeParams& params, const EncodeObserver& observer) {
  ExtendedStream stream;
  stream.header = header;
  ExtendedLevelTask task;
  task.effort = effort_of(params.preset);
  if (header.has(Feature::kSharedDisparity)) {
    const FieldDisparity found = probe_disparities(light_field, header);
    stream.header.row_scale = found.row_scale;
    task.disparities = found.range;
  }
  const Geometry geometry(stream.header);
  const Lambda lambda = lambda_of_quality(params.quality);
  stream.codes.resize(static_cast<size_t>(geometry.image_count()));
  stream.keys.codestreams.resize(static_cast<size_t>(geometry.key_count()) * kPlaneCount);
  stream.keys.crcs.resize(stream.keys.codestreams.size());
  RkvTree tree = build_rkv_tree(light_field, geometry, header.cluster_rows, header.cluster_cols);
  task.light_field = &light_field;
  task.header = &stream.header;
  task.geometry = &geometry;
  task.targets = extended_targets(light_field, stream.header, params, lambda);
  task.motion_lambda = lambda;
  task.tree = &tree;
  task.codes = &stream.codes;
  task.keys = &stream.keys;
  task.error = &stream.error;
  task.observer = &observer;
  for (int level = geometry.top(); level >= 0; --level) {
    task.level = level;
    encode_extended_level(task);
    if (level < geometry.top()) tree.levels[static_cast<size_t>(level)].clear();
  }
  return stream;
}

std::vector<uint8_t> assemble_extended(ExtendedStream& stream) {
  const Geometry geometry(stream.header);
  IndexWriter index;
  for (ExtendedImageCode& image : stream.codes) {
    for (size_t p = 0; p < kPlaneCount + geometry.motion_planes().size(); ++p) {
      PlaneCode& code = image[p];
      const uint64_t tiles = p < kPlaneCount ? geometry.plane(kPlanes[p]).tiles()
                                             : geometry.motion_planes()[0].tiles();
      // What has no records, like the planes of a key image, has empty tiles alone.
      code.record_sizes.resize(static_cast<size_t>(tiles), 0);
      size_t at = 0;
      for (const uint32_t size : code.record_sizes) {
        index.add(std::span(code.records).subspan(at, size));
        at += size;
      }
      code = {};
    }
  }
  index.finish();
  return assemble_stream(stream.header, top_section(stream.keys.codestreams, stream.keys.crcs),
                         index);
}

}  // namespace hmlfc
