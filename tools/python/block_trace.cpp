#include "python/block_trace.hpp"

#include "python/arrays.hpp"

namespace py = pybind11;

namespace hmlfc::python {
namespace {

py::str text(std::string_view view) { return {view.data(), view.size()}; }

// The names of vectors/README.md.
py::dict dict_of(const BlockSite& site) {
  py::dict dict;
  dict["level"] = site.level;
  dict["image"] = py::make_tuple(site.image_row, site.image_col);
  dict["plane"] = text(plane_name(site.plane));
  dict["block"] = py::make_tuple(site.bx, site.by);
  return dict;
}

}  // namespace

py::list BlockTrace::fields() const {
  py::list list;
  for (const FieldRecord& field : fields_) {
    py::dict dict = dict_of(field.site);
    dict["tile"] = text(tile_kind_name(field.site.tile));
    dict["section"] = text(section_name(field.section));
    dict["byte"] = field.bit / 8;
    dict["bit"] = field.bit % 8;
    dict["bits"] = field.bits;
    dict["name"] = text(field.name);
    dict["clause"] = text(field.clause);
    dict["value"] =
        field.bits == 64 ? py::int_(static_cast<uint64_t>(field.value)) : py::int_(field.value);
    list.append(dict);
  }
  return list;
}

py::list BlockTrace::vectors() const {
  py::list list;
  for (const VectorRecord& vector : vectors_) {
    py::dict dict = dict_of(vector.site);
    dict["reference"] = py::make_tuple(vector.image_row, vector.image_col);
    dict["vector"] = py::make_tuple(vector.x / 8.0, vector.y / 8.0);
    dict["clause"] = text(vector.clause);
    list.append(dict);
  }
  return list;
}

py::list BlockTrace::stages(py::ssize_t side) const {
  py::list list;
  for (const Stage& stage : stages_) {
    py::dict dict = dict_of(stage.record.site);
    dict["stage"] = text(stage.record.stage);
    dict["clause"] = text(stage.record.clause);
    dict["values"] = array_of(stage.values, {side, side});
    list.append(dict);
  }
  return list;
}

}  // namespace hmlfc::python
