#include "encoder/coded_images.hpp"

#include <utility>

#include "bits/little_endian.hpp"

namespace hmlfc {

std::vector<uint8_t> CodedKeys::codestream(size_t plane) const {
  const KeyPlane& key = planes_[plane];
  if (storage_ == nullptr) return key.codestream;
  std::vector<uint8_t> bytes(key.size);
  storage_->read(key.offset, bytes);
  return bytes;
}

void CodedKeys::set(size_t plane, std::vector<uint8_t> codestream, uint32_t crc) {
  KeyPlane& key = planes_[plane];
  key.crc = crc;
  key.size = static_cast<uint32_t>(codestream.size());
  if (storage_ != nullptr) {
    key.offset = storage_->append(codestream);
  } else {
    key.codestream = std::move(codestream);
  }
}

CodedRecords::CodedRecords(size_t images, CodeStorage* storage)
    : storage_(storage), images_(images), places_(storage != nullptr ? images : 0) {}

void CodedRecords::close(size_t image) {
  if (storage_ == nullptr) return;
  const std::vector<uint8_t> bytes = to_bytes(images_[image]);
  places_[image] = {storage_->append(bytes), bytes.size()};
  images_[image] = {};
}

void CodedRecords::visit(size_t image, const std::function<void(const ImageCode&)>& body) const {
  if (storage_ == nullptr || places_[image].size == 0) return body(images_[image]);
  std::vector<uint8_t> bytes(static_cast<size_t>(places_[image].size));
  storage_->read(places_[image].offset, bytes);
  body(image_code_of(bytes));
}

std::vector<uint8_t> to_bytes(const ImageCode& code) {
  std::vector<uint8_t> bytes;
  for (const PlaneCode& plane : code) {
    append_le(bytes, static_cast<uint32_t>(plane.record_sizes.size()));
    for (const uint32_t size : plane.record_sizes) append_le(bytes, size);
    bytes.insert(bytes.end(), plane.records.begin(), plane.records.end());
  }
  return bytes;
}

ImageCode image_code_of(std::span<const uint8_t> bytes) {
  ImageCode code;
  size_t at = 0;
  const auto next = [&] {
    const auto value = load_le<uint32_t>(bytes, at);
    at += sizeof(value);
    return value;
  };
  for (PlaneCode& plane : code) {
    plane.record_sizes.resize(next());
    size_t records = 0;
    for (uint32_t& size : plane.record_sizes) {
      size = next();
      records += size;
    }
    const auto from = bytes.subspan(at, records);
    plane.records.assign(from.begin(), from.end());
    at += records;
  }
  return code;
}

}  // namespace hmlfc
