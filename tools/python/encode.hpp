// Encoding from Python.
#pragma once

#include <vector>

#include "python/object.hpp"

namespace hmlfc::python {

/// Adds what encodes: folder_field() and array_field() make a field, which field_facts(),
/// field_pixels() and encode() take.
void add_encode(std::vector<PyMethodDef>& methods);

}  // namespace hmlfc::python
