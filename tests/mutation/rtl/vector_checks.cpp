#include <stdexcept>

#include "check.hpp"
#include "unit/units.hpp"
#include "unit_vector.hpp"

namespace hmlfc::tb {
namespace {

// Without an answer. The unit itself needs some thousand clocks for LOAD and a thousand for a
// block.
constexpr uint64_t kPatience = 20'000;
// Streams that are refused take little time but find nothing in the datapath: as if they were
// large.
constexpr uint64_t kPixelsOfRefused = 100'000;

// Its stream is decoded when the vector is tried first.
class VectorCheck final : public Check {
 public:
  VectorCheck(const std::filesystem::path& suite, const vectors::Vector& vector)
      : suite_(suite), entry_(vector) {
    if (vector.output) {
      pixels_ = uint64_t{vector.output->rows} * vector.output->cols * vector.output->width *
                vector.output->height;
    }
  }

  const std::string& id() const override { return entry_.id.text(); }
  uint64_t size() const override { return pixels_; }

  Verdict run(uint64_t& clocks) override {
    const UnitMaker maker = rtl_units().front();
    if (!vector_) vector_ = std::make_unique<UnitVector>(suite_, entry_, maker.parameters);
    return vector_->try_on(maker.make(maker.parameters), kPatience, clocks);
  }

 private:
  std::filesystem::path suite_;
  vectors::Vector entry_;
  std::unique_ptr<UnitVector> vector_;
  uint64_t pixels_ = kPixelsOfRefused;
};

}  // namespace

std::vector<std::unique_ptr<Check>> vector_checks(const std::filesystem::path& suite) {
  const auto manifest = vectors::read_manifest(suite);
  if (!manifest) throw std::runtime_error(manifest.error().message);
  const UnitParameters unit = rtl_units().front().parameters;
  std::vector<std::unique_ptr<Check>> found;
  for (const vectors::Vector& vector : manifest->vectors) {
    const auto file = io::map_file(suite / vector.input.file);
    if (!file) throw std::runtime_error(file.error().message);
    if (UnitVector::is_for(unit, file->bytes())) {
      found.push_back(std::make_unique<VectorCheck>(suite, vector));
    }
  }
  return found;
}

}  // namespace hmlfc::tb
