// The module hmlfc._core, on which the package hmlfc is written.
#include <hmlfc/version.hpp>

#include "python/encode.hpp"
#include "python/stream.hpp"

PyMODINIT_FUNC PyInit__core() {
  static std::vector<PyMethodDef> methods;
  hmlfc::python::add_stream(methods);
  hmlfc::python::add_encode(methods);
  methods.push_back({});
  static PyModuleDef definition = {PyModuleDef_HEAD_INIT,
                                   "_core",
                                   nullptr,
                                   -1,
                                   methods.data(),
                                   nullptr,
                                   nullptr,
                                   nullptr,
                                   nullptr};
  PyObject* module = PyModule_Create(&definition);
  if (module != nullptr) PyModule_AddStringConstant(module, "version", HMLFC_VERSION);
  return module;
}
