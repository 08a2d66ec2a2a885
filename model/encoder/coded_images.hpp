// The images of a light field as they are coded, in memory or in storage.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <hmlfc/code_storage.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/measure.hpp>

namespace hmlfc {

/// The tile records of one plane, in tile order, one after another.
struct PlaneCode {
  std::vector<uint32_t> record_sizes;  ///< bytes of each tile's record, 0 where it is empty
  std::vector<uint8_t> records;

  void append(std::span<const uint8_t> record) {
    record_sizes.push_back(static_cast<uint32_t>(record.size()));
    records.insert(records.end(), record.begin(), record.end());
  }
};

/// The records of one image: Y, Co, Cg, then the motion plane. A plane without any record has empty
/// tiles alone.
using ImageCode = std::array<PlaneCode, kPlaneCount + 1>;
inline constexpr size_t kMotionPlane = kPlaneCount;

/// The planes of the key images in the order of KEY-1: codestreams and CRCs of their samples. In
/// storage if there is one, else in memory. Threads may work on different planes.
class CodedKeys {
 public:
  CodedKeys() = default;
  CodedKeys(size_t planes, CodeStorage* storage) : storage_(storage), planes_(planes) {}

  size_t count() const { return planes_.size(); }
  bool has(size_t plane) const { return planes_[plane].size > 0; }
  uint32_t size(size_t plane) const { return planes_[plane].size; }
  uint32_t crc(size_t plane) const { return planes_[plane].crc; }
  std::vector<uint8_t> codestream(size_t plane) const;

  void set(size_t plane, std::vector<uint8_t> codestream, uint32_t crc);

 private:
  struct KeyPlane {
    std::vector<uint8_t> codestream;  // without a storage
    uint64_t offset = 0;
    uint32_t size = 0;
    uint32_t crc = 0;
  };

  CodeStorage* storage_ = nullptr;
  std::vector<KeyPlane> planes_;
};

/// The records of all images by image number, likewise.
class CodedRecords {
 public:
  CodedRecords() = default;
  CodedRecords(size_t images, CodeStorage* storage);

  size_t count() const { return images_.size(); }

  /// An image being coded, from which close() takes what it has.
  ImageCode& open(size_t image) { return images_[image]; }

  /// The image is complete: it goes to the storage, if there is one.
  void close(size_t image);

  /// Calls body(code) with what was closed.
  void visit(size_t image, const std::function<void(const ImageCode&)>& body) const;

 private:
  struct Place {
    uint64_t offset = 0;
    uint64_t size = 0;
  };

  CodeStorage* storage_ = nullptr;
  std::vector<ImageCode> images_;
  std::vector<Place> places_;  // with a storage
};

/// All images of a light field, coded.
struct CodedImages {
  CodedRecords records;
  CodedKeys keys;
  ErrorSums error;  ///< of all views
};

/// One image's records as bytes, and back; `bytes` are whole and come from to_bytes().
std::vector<uint8_t> to_bytes(const ImageCode& code);
ImageCode image_code_of(std::span<const uint8_t> bytes);

}  // namespace hmlfc
