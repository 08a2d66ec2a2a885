#include "python/block_trace.hpp"

#include "python/arrays.hpp"

namespace hmlfc::python {
namespace {

// The names of vectors/README.md.
Object dict_of(const BlockSite& site) {
  Object dict(PyDict_New());
  put(dict, "level", site.level);
  put(dict, "image", tuple_of(site.image_row, site.image_col));
  put(dict, "plane", plane_name(site.plane));
  put(dict, "block", tuple_of(site.bx, site.by));
  return dict;
}

}  // namespace

Object BlockTrace::fields() const {
  std::vector<Object> list;
  for (const FieldRecord& field : fields_) {
    Object& dict = list.emplace_back(dict_of(field.site));
    put(dict, "tile", tile_kind_name(field.site.tile));
    put(dict, "section", section_name(field.section));
    put(dict, "byte", field.bit / 8);
    put(dict, "bit", field.bit % 8);
    put(dict, "bits", field.bits);
    put(dict, "name", field.name);
    put(dict, "clause", field.clause);
    if (field.bits == 64) {
      put(dict, "value", static_cast<uint64_t>(field.value));
    } else {
      put(dict, "value", field.value);
    }
  }
  return object_of(list);
}

Object BlockTrace::vectors() const {
  std::vector<Object> list;
  for (const VectorRecord& vector : vectors_) {
    Object& dict = list.emplace_back(dict_of(vector.site));
    put(dict, "reference", tuple_of(vector.image_row, vector.image_col));
    put(dict, "vector", tuple_of(vector.x / 8.0, vector.y / 8.0));
    put(dict, "clause", vector.clause);
  }
  return object_of(list);
}

Object BlockTrace::stages(size_t side) const {
  std::vector<Object> list;
  for (const Stage& stage : stages_) {
    Object& dict = list.emplace_back(dict_of(stage.record.site));
    put(dict, "stage", stage.record.stage);
    put(dict, "clause", stage.record.clause);
    put(dict, "values", array_of<int32_t>(stage.values, {side, side}));
  }
  return object_of(list);
}

}  // namespace hmlfc::python
