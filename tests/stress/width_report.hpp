// What the rows of a width table reached over a whole run, and by what.
#pragma once

#include <string>
#include <vector>

#include "vectors/json.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {

class WidthReport {
 public:
  explicit WidthReport(WidthTable table) : places_(places(table)), records_(places_.size()) {}

  /// Takes in what `name` reached.
  void add(const std::string& name, const Ranges& ranges);

  /// Each place of the table: its proved interval, what was reached, and by which names first.
  vectors::Json rows() const;

 private:
  struct Record {
    Reached reached;
    std::string least_by;
    std::string greatest_by;
  };

  std::vector<Place> places_;
  std::vector<Record> records_;
};

}  // namespace hmlfc::stress
