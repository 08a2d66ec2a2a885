#include "unit/stand_in.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hmlfc::tb {
namespace {

constexpr size_t kMaxJobs = 16;
constexpr uint64_t kMemoryPage = 4096;
constexpr uint64_t kFirstFault = 20;

}  // namespace

StandIn::StandIn(const UnitParameters& parameters, Fault fault)
    : parameters_(parameters), fault_(fault), registers_(parameters) {}

void StandIn::clock(const UnitInputs& at_edge, const UnitInputs&, UnitOutputs& outputs) {
  if (at_edge.rst_n) {
    take(at_edge);
    show();
  } else {
    reset();
  }
  outputs = out_;
}

void StandIn::reset() {
  registers_ = RegisterFile(parameters_);
  stream_.clear();
  oracle_.reset();
  reads_.reset();
  golden_.reset();
  fetches_.clear();
  outstanding_ = 0;
  jobs_.clear();
  out_ = {};
  address_held_ = data_held_ = false;
}

// Whether `fault` is to be planted now; says so once.
bool StandIn::plant(Fault fault) {
  if (fault_ != fault || answers_ < kFirstFault) return false;
  fault_ = Fault::kNone;
  return true;
}

void StandIn::take(const UnitInputs& in) {
  if (!jobs_.empty()) ++registers_.cycles;
  if (out_.response_valid) {
    if (in.response_ready) {
      answered();
    } else {
      ++registers_.stalls;
      if (plant(Fault::kBlocks)) ++registers_.blocks;
      if (plant(Fault::kUnstable)) out_.answer.samples[0] ^= 1;
    }
  }
  if (out_.ar_valid && in.ar_ready) {
    fetches_.pop_front();
    ++outstanding_;
    out_.ar_valid = false;
  }
  if (in.r_valid && out_.r_ready) {
    if (in.r_last) --outstanding_;
    take_read(in);
  }
  if (in.request_valid && out_.request_ready) {
    add_job(Request::of_word(in.request_data, in.request_last));
  }
  take_registers(in);
}

void StandIn::answered() {
  out_.response_valid = false;
  if (plant(Fault::kDuplicated)) {
    out_.response_valid = true;
    return;
  }
  registers_.count_answer(jobs_.front().request.word(), out_.answer.status);
  if (plant(Fault::kCounter)) registers_.count_answer(0, 0);
  registers_.blocks += jobs_.front().blocks;
  jobs_.pop_front();
  ++answers_;
}

void StandIn::take_read(const UnitInputs& in) {
  registers_.bytes_read += parameters_.beat_bytes;
  if (registers_.loading) {
    const size_t left = static_cast<size_t>(registers_.stream_bytes()) - stream_.size();
    const auto* bytes = reinterpret_cast<const uint8_t*>(in.r_data.data());
    stream_.insert(stream_.end(), bytes, bytes + std::min<size_t>(left, parameters_.beat_bytes));
    if (stream_.size() == registers_.stream_bytes()) end_load();
    return;
  }
  if (!in.r_last) return;
  const auto job = std::ranges::find(jobs_, false, &Job::fetched);
  if (job == jobs_.end()) return;
  job->fetched = true;
  if (in.r_resp == 0) return;
  spoil(*job);
  // Not once: the next request may depend on such a beat as well.
  if (fault_ == Fault::kNeighbour && std::next(job) != jobs_.end()) spoil(*std::next(job));
}

void StandIn::spoil(Job& job) {
  job.records.clear();
  job.expected.answer.samples = {};
  job.expected.answer.status = kBusError;
}

void StandIn::take_registers(const UnitInputs& in) {
  if (out_.b_valid && in.b_ready) out_.b_valid = false;
  if (out_.lite_r_valid && in.lite_r_ready) out_.lite_r_valid = false;
  if (in.aw_valid && out_.aw_ready) {
    address_held_ = true;
    write_address_ = in.aw_addr;
  }
  if (in.w_valid && out_.w_ready) {
    data_held_ = true;
    write_data_ = in.w_data;
  }
  if (address_held_ && data_held_ && !out_.b_valid) {
    address_held_ = data_held_ = false;
    out_.b_valid = true;
    control(registers_.write(write_address_, write_data_));
  }
  if (in.lite_ar_valid && out_.lite_ar_ready) {
    registers_.idle = jobs_.empty();
    out_.lite_r_valid = true;
    out_.lite_r_data = registers_.read(in.lite_ar_addr);
  }
}

void StandIn::control(uint32_t bits) {
  if ((bits & HMLFC_REG_CONTROL_DISABLE_MASK) != 0) {
    oracle_.reset();
    registers_.ready = false;
    wanted_ = false;
  }
  if ((bits & HMLFC_REG_CONTROL_LOAD_MASK) == 0) return;
  wanted_ = true;
  if (!registers_.loading) begin_load();
}

void StandIn::begin_load() {
  oracle_.reset();
  reads_.reset();
  golden_.reset();
  stream_.clear();
  chroma_.reset();
  registers_.loading = true;
  registers_.ready = false;
  fetch(registers_.stream_base(), registers_.stream_bytes());
  if (registers_.stream_bytes() == 0) end_load();
}

void StandIn::end_load() {
  auto opened = GoldenStream::open(stream_, parameters_);
  // The TOP table is software's to check (KEY-1): the unit takes a stream with a bad one.
  const bool taken = opened || GoldenStream::is_of_top_table(opened.error());
  registers_.loading = false;
  registers_.ready = taken && wanted_;
  registers_.load_error = taken ? 0 : static_cast<uint8_t>(opened.error().code);
  if (!wanted_) return;
  if (opened) {
    golden_ = std::move(*opened);
    oracle_ = std::make_unique<Oracle>(*golden_, &golden_->fast_references());
    reads_ = std::make_unique<BlockReads>(*golden_);
  } else {
    oracle_ = std::make_unique<Oracle>(registers_.load_error);
  }
}

void StandIn::fetch(uint64_t address, uint64_t bytes) {
  const uint64_t beat = parameters_.beat_bytes;
  for (const uint64_t end = address + bytes; address < end;) {
    const uint64_t to =
        std::min({end, address + 16 * beat, (address / kMemoryPage + 1) * kMemoryPage});
    fetches_.push_back({address, static_cast<unsigned>((to - address + beat - 1) / beat)});
    address = to;
  }
}

void StandIn::add_job(const Request& request) {
  Job job{.request = request, .expected = oracle_->evaluate(request)};
  const auto chroma = chroma_key(job.expected);
  const bool held = chroma && chroma == chroma_;
  if (chroma) chroma_ = chroma;
  if (!job.expected.planes[0]) job.blocks = 1;
  for (const auto& plane : job.expected.planes) {
    if (!plane || (held && plane != job.expected.planes[0])) continue;
    job.blocks += plane->levels.size();
    if (job.expected.answer.status != 0) continue;
    for (const LevelRecord& level : plane->levels) job.records.push_back(&level);
  }
  fetch_for(job);
  jobs_.push_back(std::move(job));
}

// One beat with a byte that the answer depends on.
void StandIn::fetch_for(Job& job) {
  const auto ranges = reads_ ? reads_->of(job.request) : std::vector<ByteRange>();
  if (ranges.empty()) {
    job.fetched = true;
    return;
  }
  const uint64_t beat = parameters_.beat_bytes;
  if (plant(Fault::kBurst)) {
    fetches_.push_back(
        {registers_.stream_base() / kMemoryPage * kMemoryPage + kMemoryPage - beat, 2});
    return;
  }
  const ByteRange& range = ranges[random_.below(ranges.size())];
  const uint64_t base = range.in_area ? registers_.reference_base() : registers_.stream_base();
  const uint64_t at = base + range.begin + random_.below(range.end - range.begin);
  fetches_.push_back({at / beat * beat, 1});
}

void StandIn::show() {
  out_.request_ready = oracle_ != nullptr && jobs_.size() < kMaxJobs;
  if (!out_.ar_valid && !fetches_.empty() && outstanding_ < parameters_.outstanding) {
    out_.ar_valid = true;
    out_.ar_addr = fetches_.front().address;
    out_.ar_len = static_cast<uint8_t>(fetches_.front().beats - 1);
    out_.ar_size = static_cast<uint8_t>(std::countr_zero(parameters_.beat_bytes));
    out_.ar_burst = 1;
    out_.ar_id = 0;
  }
  out_.r_ready = true;
  out_.aw_ready = !address_held_;
  out_.w_ready = !data_held_;
  out_.lite_ar_ready = !out_.lite_r_valid;
  out_.trace_valid = false;
  if (jobs_.empty() || !jobs_.front().fetched || out_.response_valid) return;
  if (jobs_.front().reported < jobs_.front().records.size()) {
    show_trace();
  } else {
    show_answer();
  }
}

void StandIn::show_trace() {
  Job& job = jobs_.front();
  const LevelRecord& record = *job.records[job.reported++];
  if (plant(Fault::kRecordMissing)) return;
  out_.trace_valid = true;
  out_.trace = record;
  if (!record.key && plant(Fault::kStage)) out_.trace.prediction[0] ^= 4;
  if (record.motion && plant(Fault::kVector)) ++out_.trace.vectors[0].ix;
}

void StandIn::show_answer() {
  if (jobs_.size() > 1 && plant(Fault::kSwapped)) {
    std::swap(jobs_[0].expected.answer, jobs_[1].expected.answer);
  }
  if (jobs_.size() > 1 && plant(Fault::kDropped)) {
    jobs_.pop_front();
    return;
  }
  out_.response_valid = true;
  out_.answer = jobs_.front().expected.answer;
  if (out_.answer.status == 0 && plant(Fault::kSample)) out_.answer.samples[0] ^= 1;
  if (plant(Fault::kStatus)) out_.answer.status ^= 5;
  if (plant(Fault::kLast)) out_.answer.last = !out_.answer.last;
}

}  // namespace hmlfc::tb
