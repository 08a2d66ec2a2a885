// Python's objects through its stable ABI, so that one module serves every Python from 3.11 on.
// Needs the GIL, apart from Locked.
#pragma once

#define Py_LIMITED_API 0x030B0000
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hmlfc::python {

/// Holds the GIL, in any thread.
class Locked {
 public:
  Locked() : state_(PyGILState_Ensure()) {}
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  ~Locked() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_;
};

/// Lets go of the GIL meanwhile. Where Python has ended, its daemon threads end at the `}`: what
/// unwinds them passes through.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() noexcept(false) { PyEval_RestoreThread(state_); }

 private:
  PyThreadState* state_;
};

/// Thrown for an exception of Python, which it takes along, also to another thread.
class Raised {
 public:
  /// What a function of Python has just raised.
  Raised() : taken_(std::make_shared<Taken>()) {}
  /// A new one.
  Raised(PyObject* type, const std::string& text) {
    PyObject* message = PyUnicode_DecodeUTF8(text.data(), std::ssize(text), "replace");
    if (message != nullptr) PyErr_SetObject(type, message);
    Py_XDECREF(message);
    taken_ = std::make_shared<Taken>();
  }

  void raise_again() const {
    PyErr_Restore(Py_XNewRef(taken_->type), Py_XNewRef(taken_->value),
                  Py_XNewRef(taken_->traceback));
  }

 private:
  struct Taken {
    Taken() { PyErr_Fetch(&type, &value, &traceback); }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;
    ~Taken() {
      const Locked locked;
      for (PyObject* object : {type, value, traceback}) Py_XDECREF(object);
    }
    PyObject* type = nullptr;
    PyObject* value = nullptr;
    PyObject* traceback = nullptr;
  };

  std::shared_ptr<const Taken> taken_;
};

/// A reference to an object.
class Object {
 public:
  /// Of a new reference, as a function of Python returns it; throws what was raised where it is
  /// null.
  explicit Object(PyObject* made) : object_(made) {
    if (made == nullptr) throw Raised();
  }
  Object(const Object& other) : object_(Py_NewRef(other.object_)) {}
  Object(Object&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Object& operator=(Object other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Object() { Py_XDECREF(object_); }

  PyObject* get() const { return object_; }
  PyObject* release() { return std::exchange(object_, nullptr); }

 private:
  PyObject* object_;
};

/// A number, a text, an object, a list of these, or None of what is not there.
template <class T>
Object object_of(const T& value) {
  if constexpr (std::is_same_v<T, Object>) {
    return value;
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    const std::string_view text = value;
    return Object(PyUnicode_FromStringAndSize(text.data(), std::ssize(text)));
  } else if constexpr (std::is_same_v<T, bool>) {
    return Object(PyBool_FromLong(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return Object(PyFloat_FromDouble(value));
  } else if constexpr (std::is_unsigned_v<T>) {
    return Object(PyLong_FromUnsignedLongLong(value));
  } else if constexpr (std::is_integral_v<T>) {
    return Object(PyLong_FromLongLong(value));
  } else if constexpr (requires { value.has_value(); }) {
    return value ? object_of(*value) : Object(Py_NewRef(Py_None));
  } else {
    Object list(PyList_New(0));
    for (const auto& item : value) {
      if (PyList_Append(list.get(), object_of(item).get()) != 0) throw Raised();
    }
    return list;
  }
}

template <class... T>
Object tuple_of(const T&... values) {
  Object tuple(PyTuple_New(sizeof...(values)));
  Py_ssize_t at = 0;
  (PyTuple_SetItem(tuple.get(), at++, object_of(values).release()), ...);
  return tuple;
}

/// dict[name] = value
template <class T>
void put(const Object& dict, const char* name, const T& value) {
  if (PyDict_SetItemString(dict.get(), name, object_of(value).get()) != 0) throw Raised();
}

/// The bytes of an object that lie in one piece; the object keeps them there for as long as this
/// lives.
class Buffer {
 public:
  /// `flags`: PyBUF_SIMPLE, PyBUF_WRITABLE, PyBUF_ND.
  Buffer(PyObject* object, int flags) : view_(std::make_unique<Py_buffer>()) {
    if (PyObject_GetBuffer(object, view_.get(), flags) != 0) throw Raised();
  }
  Buffer(Buffer&&) = default;
  ~Buffer() {
    if (view_) PyBuffer_Release(view_.get());
  }

  const Py_buffer& view() const { return *view_; }

 private:
  std::unique_ptr<Py_buffer> view_;
};

/// `value` as an object that only this module looks into; T is complete and has its own kName.
template <class T>
Object hold(std::unique_ptr<T> value) {
  Object capsule(PyCapsule_New(value.get(), T::kName, [](PyObject* held) {
    delete static_cast<T*>(PyCapsule_GetPointer(held, T::kName));
  }));
  value.release();
  return capsule;
}

}  // namespace hmlfc::python
