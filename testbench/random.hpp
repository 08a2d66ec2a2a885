// The numbers of a seed for the bench: the generator of the vectors.
#pragma once

#include "vectors/random.hpp"

namespace hmlfc::tb {

using vectors::Random;

}  // namespace hmlfc::tb
