// What ends a function of gpu_ref inside.
#pragma once

#include <stdexcept>
#include <string>

#include <hmlfc/gpu/device.hpp>

namespace hmlfc::gpu {

/// Thrown inside gpu_ref with what a Failure says; its public functions catch it.
class MachineError : public std::runtime_error {
 public:
  MachineError(FailureKind kind, const std::string& message)
      : std::runtime_error(message), kind_(kind) {}

  FailureKind kind() const { return kind_; }

 private:
  FailureKind kind_;
};

}  // namespace hmlfc::gpu
