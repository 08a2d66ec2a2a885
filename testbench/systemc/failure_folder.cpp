#include "systemc/failure_folder.hpp"

#include <algorithm>

#include "oracle/trace_text.hpp"
#include "stimulus/sequences.hpp"

namespace hmlfc::tb {
namespace {

TextFile create(const std::filesystem::path& path) {
  return TextFile(std::fopen(path.c_str(), "w"));
}

// One run of `requests` in a fresh unit with wave and trace; the first finding.
std::optional<Mismatch> repeat(Bench& bench, const UnitMaker& maker, StreamImage& image,
                               const std::vector<Request>& requests, uint32_t state_seed,
                               const std::filesystem::path& folder) {
  UnitParameters parameters = maker.parameters;
  parameters.state_seed = state_seed;
  auto unit = maker.make(parameters, nullptr);
  const TextFile trace = create(folder / "unit.txt");
  const unsigned size = maker.parameters.block_size();
  bench.attach(std::move(unit));
  bench.unit().open_wave((folder / "wave.fst").string());
  image.load_into(bench);
  bench.set_listener([&](const UnitOutputs& out) {
    if (out.trace_valid) write_record(trace.get(), out.trace, size);
    if (out.response_valid) write_answer(trace.get(), out.answer, size);
  });
  if (!bench.findings().first()) {
    bench.run(listed_requests(requests), image.oracle(), Conditions{}, 0);
  }
  bench.set_listener({});
  return bench.findings().first();
}

}  // namespace

RequestSource RecordedSource::record(RequestSource source) {
  return [this, source = std::move(source)]() -> std::optional<Request> {
    const auto request = source();
    if (!request) return request;
    last_.push_back(*request);
    if (last_.size() > kept_) last_.pop_front();
    return request;
  };
}

std::filesystem::path keep_failure(Bench& bench, const UnitMaker& maker, StreamImage& image,
                                   const Failure& failure, const std::filesystem::path& root) {
  const std::filesystem::path folder = root / "failure" / failure.id;
  std::filesystem::create_directories(folder);
  bench.keep_places();
  const auto& request = failure.mismatch.request;
  std::optional<Mismatch> again;
  std::string which = "the block alone";
  const uint32_t state = std::max(failure.mismatch.state_seed, 1u);
  if (request) again = repeat(bench, maker, image, {*request}, state, folder);
  if (!again) {
    which = "the block with the " + std::to_string(failure.history.size()) + " requests around it";
    again = repeat(bench, maker, image, failure.history, state, folder);
  }
  if (request) {
    write_expected(create(folder / "model.txt").get(), image.oracle().evaluate(*request),
                   maker.parameters.block_size());
  }
  const TextFile message = create(folder / "message.txt");
  std::fprintf(message.get(), "%s\nrepeating %s: %s\nwhole run: %s\n",
               to_string(failure.mismatch).c_str(), which.c_str(),
               again ? to_string(*again).c_str() : "no difference", failure.replay.c_str());
  if (!std::filesystem::exists(folder / "wave.fst")) {
    std::fprintf(message.get(),
                 "no wave: blocks of 4 x 4 in the Verilated unit have one after\n"
                 "cmake --preset release -DHMLFC_RTL_WAVES=ON\n");
  }
  return folder;
}

}  // namespace hmlfc::tb
