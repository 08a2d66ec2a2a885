#include "systemc/stream_image.hpp"

namespace hmlfc::tb {

StreamImage::StreamImage(std::span<const uint8_t> bytes, const UnitParameters& unit)
    : bytes_(bytes) {
  auto opened = GoldenStream::open(bytes, unit);
  if (opened) {
    golden_ = std::move(*opened);
    // Fast references, as software would use; the oracle has golden ones.
    area_ = build_reference_area(golden_->view(), golden_->keys(), golden_->fast_references());
    oracle_ = std::make_unique<Oracle>(*golden_);
  } else {
    load_error_ = static_cast<uint8_t>(opened.error().code);
    left_to_software_ = GoldenStream::is_of_top_table(opened.error());
    oracle_ = std::make_unique<Oracle>(load_error_);
  }
}

MemoryImage StreamImage::memory() const {
  MemoryImage image;
  image.stream = bytes_;
  image.reference_area = area_.bytes;
  return image;
}

void StreamImage::load_into(Bench& bench) const {
  bench.set_image(memory());
  const std::optional<uint32_t> status = bench.load();
  if (!status) return;
  const bool ready = (*status & HMLFC_REG_STATUS_READY_MASK) != 0;
  const unsigned expected = left_to_software_ ? 0 : load_error_;
  if (reg::load_error(*status) == expected && ready == (expected == 0)) {
    bench.coverage().on_error(static_cast<uint8_t>(expected));
    return;
  }
  bench.findings().add({"registers: error of LOAD",
                        {},
                        {},
                        "expected " + status_name(expected) + ", actual " +
                            status_name(reg::load_error(*status)) +
                            (ready ? " and ready" : " and not ready"),
                        bench.cycle()});
}

}  // namespace hmlfc::tb
