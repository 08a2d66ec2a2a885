// Every allocation of the functions of hmlfc.h fails once: they say out_of_memory, and the same
// call works afterwards.
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/hmlfc.h>

namespace {

// Allocations until one fails; below 0: none does. Each call of a test begins with a number of its
// own.
std::atomic<int64_t> allowed = -1;

void* allocate(size_t size) {
  if (allowed.load() >= 0 && allowed.fetch_sub(1) == 0) throw std::bad_alloc();
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(size_t size) { return allocate(size); }
void* operator new[](size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }

namespace {

const char* const kStream = HMLFC_VECTORS "/real/knights-extended.hmlfc";

// Calls `function` with the first, the second, ... allocation failing until it has none to fail.
// Returns how many failed.
int fail_each(const std::function<int(hmlfc_failure&)>& function) {
  for (int failing = 0;; ++failing) {
    hmlfc_failure failure{};
    failure.struct_size = sizeof failure;
    allowed = failing;
    const int status = function(failure);
    const bool has_failed = allowed.exchange(-1) < 0;
    if (!has_failed) {
      EXPECT_EQ(status, HMLFC_STATUS_OK) << failure.text;
      return failing;
    }
    EXPECT_EQ(status, HMLFC_STATUS_OUT_OF_MEMORY) << "allocation " << failing << failure.text;
    EXPECT_EQ(std::string(failure.text).rfind("out_of_memory", 0), 0u);
  }
}

hmlfc_decoder* opened() {
  hmlfc_decoder* decoder = nullptr;
  EXPECT_EQ(hmlfc_open_file(kStream, nullptr, &decoder, nullptr), HMLFC_STATUS_OK);
  return decoder;
}

TEST(COutOfMemory, Opening) {
  const int failed = fail_each([](hmlfc_failure& failure) {
    hmlfc_decoder* decoder = nullptr;
    const int status = hmlfc_open_file(kStream, nullptr, &decoder, &failure);
    EXPECT_EQ(decoder == nullptr, status != HMLFC_STATUS_OK);
    hmlfc_close(decoder);
    return status;
  });
  EXPECT_GT(failed, 2);
}

TEST(COutOfMemory, DecodingABlock) {
  const int failed = fail_each([](hmlfc_failure& failure) {
    const int64_t held = allowed.exchange(-1);
    hmlfc_decoder* decoder = opened();
    hmlfc_block block{};
    block.struct_size = sizeof block;
    block.row = 1;
    int32_t samples[64];
    allowed = held;
    const int status = hmlfc_decode_block(decoder, &block, samples, 64, &failure);
    hmlfc_close(decoder);
    return status;
  });
  EXPECT_GT(failed, 0);
}

TEST(COutOfMemory, OpeningARenderer) {
  hmlfc_decoder* decoder = opened();
  const int failed = fail_each([decoder](hmlfc_failure& failure) {
    hmlfc_renderer* renderer = nullptr;
    const int status = hmlfc_open_renderer(decoder, nullptr, &renderer, &failure);
    EXPECT_EQ(renderer == nullptr, status != HMLFC_STATUS_OK);
    hmlfc_close_renderer(renderer);
    return status;
  });
  EXPECT_GT(failed, 2);
  hmlfc_close(decoder);
}

TEST(COutOfMemory, DecodingAView) {
  const int failed = fail_each([](hmlfc_failure& failure) {
    const int64_t held = allowed.exchange(-1);
    hmlfc_decoder* decoder = opened();
    std::vector<uint8_t> samples(size_t{3} << 20);
    hmlfc_pixels pixels{};
    pixels.struct_size = sizeof pixels;
    pixels.data = samples.data();
    pixels.bytes = samples.size();
    pixels.sample_bytes = 1;
    allowed = held;
    const int status = hmlfc_decode_view(decoder, 1, 1, &pixels, &failure);
    hmlfc_close(decoder);
    return status;
  });
  EXPECT_GT(failed, 10);
}

// Even the text of an error needs memory: either the error is told, or that memory is missing.
TEST(COutOfMemory, ErrorsOfAStream) {
  const std::vector<uint8_t> bytes(200, 0);
  for (int64_t failing = 0; failing < 8; ++failing) {
    hmlfc_failure failure{};
    failure.struct_size = sizeof failure;
    hmlfc_decoder* decoder = nullptr;
    allowed = failing;
    const int status = hmlfc_open_memory(bytes.data(), bytes.size(), nullptr, &decoder, &failure);
    const bool has_failed = allowed.exchange(-1) < 0;
    EXPECT_EQ(status, has_failed ? HMLFC_STATUS_OUT_OF_MEMORY : HMLFC_STATUS_BAD_MAGIC);
    EXPECT_EQ(decoder, nullptr);
    EXPECT_EQ(failure.status, status);
  }
}

}  // namespace
