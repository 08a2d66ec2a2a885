#include "width_report.hpp"

namespace hmlfc::stress {

void WidthReport::add(const std::string& name, const Ranges& ranges) {
  for (size_t i = 0; i < places_.size(); ++i) {
    const Reached& reached = ranges.at(places_[i]);
    Record& record = records_[i];
    if (reached.least < record.reached.least) record.least_by = name;
    if (reached.greatest > record.reached.greatest) record.greatest_by = name;
    record.reached.add(reached);
  }
}

vectors::Json WidthReport::rows() const {
  using vectors::Json;
  Json rows = Json::array();
  for (size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const Record& record = records_[i];
    const WidthRow& row = kWidthRows[place.row];
    const WidthInterval limits = limits_of(place);
    Json json{{"quantity", row.quantity},
              {"clause", row.clause},
              {"depth", row.by_depth ? Json(place.depth + kLeastDepth) : Json()},
              {"plane", row.by_plane ? Json(place.plane == 0 ? "Y" : "Co, Cg") : Json()},
              {"proved", {row.one_value ? limits.hi : limits.lo, limits.hi}}};
    if (record.reached.any()) {
      json["reached"] = {record.reached.least, record.reached.greatest};
      json["by"] = {record.least_by, record.greatest_by};
    }
    rows.push_back(std::move(json));
  }
  return rows;
}

}  // namespace hmlfc::stress
