// How long an encoding will take.
#pragma once

#include <cstddef>

#include <hmlfc/encoder.hpp>

namespace hmlfc::cli {

/// "Encoding will take about 3 minutes and 1.2 MB", unless it is soon done.
void note_forecast(const EncodeForecast& forecast);

/// Notes "Encoding 40 parts will take about 3 minutes", `what` being "parts", of which `done` took
/// `seconds`: after an eighth of them, unless all are soon done.
void note_forecast(size_t done, size_t all, double seconds, const char* what);

}  // namespace hmlfc::cli
