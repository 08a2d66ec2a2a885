// The module hmlfc._core, on which the package hmlfc is written.
#include <hmlfc/version.hpp>

#include "python/encode.hpp"
#include "python/stream.hpp"

PyMODINIT_FUNC PyInit__core() {
  static std::vector<PyMethodDef> methods;
  static PyModuleDef definition = {};
  if (methods.empty()) {
    hmlfc::python::add_stream(methods);
    hmlfc::python::add_encode(methods);
    methods.push_back({});
    definition.m_base = PyModuleDef_HEAD_INIT;
    definition.m_name = "_core";
    definition.m_size = -1;
    definition.m_methods = methods.data();
  }
  PyObject* module = PyModule_Create(&definition);
  if (module != nullptr) PyModule_AddStringConstant(module, "version", HMLFC_VERSION);
  return module;
}
